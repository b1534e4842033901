"use strict";
// Shows a 360-degree video (equirectangular) through a window that looks where one wants.
// Without WebGL the plain video with the browser's own controls stays.
const VERTEX = `#version 300 es
in vec2 place; out vec2 at;
void main() { at = place; gl_Position = vec4(place, 0.0, 1.0); }`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec2 at; out vec4 colour;
uniform sampler2D film; uniform vec2 look; uniform vec2 reach;
const float PI = 3.14159265359;
void main() {
  vec3 ray = normalize(vec3(at * reach, 1.0));
  float c = cos(look.y), s = sin(look.y);
  ray = vec3(ray.x, c * ray.y + s * ray.z, c * ray.z - s * ray.y);
  float yaw = look.x + atan(ray.x, ray.z);
  colour = textureLod(film, vec2(0.5 + yaw / (2.0 * PI), 0.5 - asin(ray.y) / PI), 0.0);
}`;
const STEP = Math.PI / 18;
const STEEPEST = Math.PI / 2.2;
const TURNS = { left: [-STEP, 0], right: [STEP, 0], up: [0, STEP], down: [0, -STEP] };
const KEYS = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down", Home: "ahead" };

function windowOn(canvas) {
  const gl = canvas.getContext("webgl2", { preserveDrawingBuffer: true });
  if (!gl) return null;
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "place");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  const look = gl.getUniformLocation(program, "look");
  const reach = gl.getUniformLocation(program, "reach");
  return (film, yaw, pitch) => {
    const width = Math.round(canvas.clientWidth * devicePixelRatio);
    const height = Math.round(canvas.clientHeight * devicePixelRatio);
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, gl.RGB, gl.UNSIGNED_BYTE, film);
    gl.uniform2f(look, yaw, pitch);
    // 90 degrees across the longer side.
    const longer = Math.max(width, height);
    gl.uniform2f(reach, width / longer, height / longer);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  };
}

function tell(step, kind, value) {
  const token = document.querySelector("meta[name=csrf-token]").content;
  fetch(`/event/${step}`, {
    method: "POST",
    keepalive: true,
    headers: { "X-CSRF-Token": token },
    body: new URLSearchParams({ kind, value: value.toFixed(2) }),
  }).catch(() => {});
}

function minutes(seconds) {
  return `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
}

function showPanorama(box) {
  const film = box.querySelector("video");
  const canvas = box.querySelector("canvas");
  const step = box.closest("[data-step]")?.dataset.step;
  let wasSeen = false;
  if (step) {
    film.addEventListener("play", () => {
      if (wasSeen) tell(step, "again", film.currentTime);
      wasSeen = false;
      tell(step, "play", film.currentTime);
    });
    film.addEventListener("pause", () => tell(step, "pause", film.currentTime));
    film.addEventListener("ended", () => {
      wasSeen = true;
      tell(step, "ended", film.currentTime);
    });
  }
  const draw = windowOn(canvas);
  if (!draw) return;
  const [play, restart] = [box.querySelector(".play"), box.querySelector(".restart")];
  const [bar, clock] = [box.querySelector("input"), box.querySelector(".clock")];
  const state = box.querySelector("[role=status]");
  let yaw = 0, pitch = 0, held = null;

  function show() {
    play.textContent = film.paused ? "Play" : "Pause";
    bar.max = film.duration || 1;
    bar.value = film.currentTime;
    bar.setAttribute("aria-valuetext", `${minutes(film.currentTime)} of ${minutes(film.duration || 0)}`);
    clock.textContent = `${minutes(film.currentTime)} / ${minutes(film.duration || 0)}`;
    if (film.readyState >= 2) draw(film, yaw, pitch);
    state.textContent = film.error
      ? "The video could not be loaded. Load this page again."
      : film.readyState < 2 ? "The video is being loaded." : "";
  }
  function turn(by, up) {
    yaw = (yaw + by) % (2 * Math.PI);
    pitch = Math.min(STEEPEST, Math.max(-STEEPEST, pitch + up));
    show();
  }
  function look(where) {
    if (where === "ahead") yaw = pitch = 0;
    turn(...(TURNS[where] ?? [0, 0]));
  }
  const toggle = () => (film.paused ? film.play() : film.pause());
  play.addEventListener("click", toggle);
  restart.addEventListener("click", () => { film.currentTime = 0; film.play(); });
  bar.addEventListener("input", () => { film.currentTime = Number(bar.value); });
  for (const button of box.querySelectorAll("[data-look]")) {
    button.addEventListener("click", () => look(button.dataset.look));
  }
  canvas.addEventListener("keydown", (event) => {
    if (event.key === " ") toggle();
    else if (event.key in KEYS) look(KEYS[event.key]);
    else return;
    event.preventDefault();
  });
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const scale = Math.PI / 2 / canvas.clientWidth;
    turn((held[0] - event.clientX) * scale, (event.clientY - held[1]) * scale);
    held = [event.clientX, event.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, () => { held = null; });
  }
  for (const change of ["loadeddata", "error", "play", "pause", "seeked", "timeupdate"]) {
    film.addEventListener(change, show);
  }
  addEventListener("resize", show);
  (function next() {
    if (!film.paused) show();
    requestAnimationFrame(next);
  })();
  film.controls = false;
  film.hidden = true;
  canvas.hidden = box.querySelector(".controls").hidden = false;
  show();
}

document.querySelectorAll("[data-panorama]").forEach(showPanorama);
