"use strict";
// Keeps the page of interviews on the tablet, so that it opens without a network. Pages with
// what people said are never kept.
const CACHE = "interviews";
const KEPT = [
  "/interview",
  "/offline",
  "/plan.svg",
  "/static/page.css",
  "/static/interview.css",
  "/static/interview.js",
  "/static/outbox.js",
  "/static/plan.js",
  "/static/recorder.js",
];
const PATIENCE = 4000;

addEventListener("install", (event) => {
  skipWaiting();
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(KEPT)));
});

addEventListener("activate", (event) => event.waitUntil(clients.claim()));

addEventListener("fetch", (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  if (request.method !== "GET" || origin !== location.origin) return;
  const isPage = request.mode === "navigate";
  // What scripts ask for by these addresses has to be fresh.
  if (KEPT.includes(pathname) && (isPage || request.destination)) {
    event.respondWith(freshElseKept(request, pathname));
  } else if (isPage) {
    event.respondWith(fetch(request).catch(() => caches.match("/offline")));
  }
});

async function freshElseKept(request, pathname) {
  const kept = await caches.match(pathname);
  try {
    const answer = await fetch(pathname, {
      credentials: "same-origin",
      signal: kept ? AbortSignal.timeout(PATIENCE) : undefined,
    });
    if (answer.ok) {
      const cache = await caches.open(CACHE);
      await cache.put(pathname, answer.clone());
      return answer;
    }
    // A server that was started anew asks for its address first; interviews go on.
    return kept ?? answer;
  } catch {
    return kept ?? Response.error();
  }
}
