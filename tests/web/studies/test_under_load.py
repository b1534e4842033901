"""Many participants at once, and servers that are killed."""

import random
import re
import signal
import socket
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx2
import pytest

from memorymaze.web.studies.store import open_store
from memorymaze.web.studies.study_file import Study

MakeStudy = Callable[..., Study]
ServeStudy = Callable[[Study], Any]
WAY = "Go straight on to the end of the corridor and then turn left at the junction."
PEOPLE = 200
KILLS = 20

SERVER = """
import sys
from memorymaze.web.studies.serving import serving_study
from memorymaze.web.studies.store import open_store
from memorymaze.web.studies.study_file import load_study
from memorymaze.web.serving.web import wait_for_interrupt
with open_store(load_study(sys.argv[1])) as store:
    with serving_study(store, port=int(sys.argv[2])):
        print("ready", flush=True)
        wait_for_interrupt()
"""


@pytest.mark.proof
def test_two_hundred_people_at_once_lose_nothing(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    seconds: list[float] = []
    together = threading.Barrier(PEOPLE)

    def take_part(number: int, visitor: Any) -> str:
        def timed(act: Callable[..., Any], *path: str, **fields: str) -> Any:
            began = time.monotonic()
            sent = act(*path, **fields)
            seconds.append(time.monotonic() - began)
            return sent

        visitor.reach_first_way()
        together.wait(timeout=300)
        for telling in range(4):
            [draft] = re.findall(r'formaction="([^"]+)"', visitor.page)
            for part in range(5):
                text = f"{WAY} Person {number}, draft {part}."
                sent = timed(visitor.post, draft, text=text, quiet="1")
                assert sent.status_code == 204
            sent = timed(visitor.send, text=f"{WAY} Person {number}, way {telling}.")
            assert sent.status_code == 200
            if "A short question" in visitor.page:
                visitor.send(answer_0="1")
        assert "Thank you!" in visitor.page
        return re.findall(r"Your number: <strong>(\w+)<", visitor.page)[0]

    study = make_study("online", f"quota = {PEOPLE}")
    with serve_study(study) as served, ThreadPoolExecutor(PEOPLE) as threads:
        visitors = [served.browse() for _ in range(PEOPLE)]
        for number, visitor in enumerate(visitors):
            visitor.client.timeout = 120
            # As a proxy tells it: each comes from an address of their own.
            visitor.client.headers["X-Forwarded-For"] = f"10.0.0.{number}"
        names = list(threads.map(take_part, range(PEOPLE), visitors))
        assert len(set(names)) == PEOPLE
        for number, name in enumerate(names):
            who = served.store.participant(name)
            assert who.state == "complete"
            told = [
                answer.text
                for step, answer in served.store.answers(name).items()
                if "tell" in step
            ]
            assert told == [f"{WAY} Person {number}, way {n}." for n in range(4)]
    print(
        f"{len(seconds)} posts of {PEOPLE} people at once, seconds: median "
        f"{statistics.median(seconds):.2f}, 99 % {statistics.quantiles(seconds, n=100)[98]:.2f}, "
        f"longest {max(seconds):.2f}"
    )


@pytest.mark.proof
def test_kill_minus_nine_loses_no_answer_that_was_confirmed(
    make_study: MakeStudy,
) -> None:
    study = make_study("online", "quota = 10000")
    chance = random.Random(0)
    confirmed: dict[str, set[str]] = {}
    lock = threading.Lock()
    for _ in range(KILLS):
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        server = subprocess.Popen(
            [sys.executable, "-c", SERVER, str(study.path), str(port)],
            stdout=subprocess.PIPE,
        )
        assert server.stdout is not None
        assert server.stdout.readline() == b"ready\n"
        stopped = threading.Event()

        def answer(port: int = port, stopped: threading.Event = stopped) -> None:
            while not stopped.is_set():
                address = f"http://127.0.0.1:{port}"
                with httpx2.Client(base_url=address, follow_redirects=False) as client:
                    try:
                        send_answers(client)
                    except httpx2.TransportError:
                        return

        def send_answers(client: httpx2.Client) -> None:
            page = client.get("/").text
            [token] = re.findall(r'name="csrf-token" content="(\w+)"', page)
            agreed = {f"consent.{n}": "on" for n in range(3)}
            client.post("/consent", data={"csrf_token": token, **agreed})
            name = ""
            for step, fields in (
                ("comprehension", {"attempt": "0", "answer.0": "1", "answer.1": "0"}),
                ("familiarity", {"answer.0": "0"}),
                ("scenario", {}),
            ):
                page = client.get("/study").text
                [name] = re.findall(r"Your number: <strong>(\w+)<", page)
                sent = client.post(
                    f"/study/{step}", data={"csrf_token": token, **fields}
                )
                assert sent.status_code == 303
                with lock:
                    confirmed.setdefault(name, set()).add(step)

        threads = [threading.Thread(target=answer) for _ in range(4)]
        for thread in threads:
            thread.start()
        time.sleep(chance.uniform(0.1, 1.5))
        server.send_signal(signal.SIGKILL)
        server.wait()
        server.stdout.close()
        stopped.set()
        for thread in threads:
            thread.join()
    with open_store(study) as store:
        for name, steps in confirmed.items():
            assert steps <= set(store.answers(name)), name
    answers = sum(map(len, confirmed.values()))
    assert answers > 10 * KILLS
    print(f"{KILLS} kills, {answers} confirmed answers of {len(confirmed)}, none lost")


@pytest.mark.proof
def test_a_served_study_keeps_another_server_out(
    make_study: MakeStudy,
) -> None:
    study = make_study()
    with open_store(study):
        done = subprocess.run(
            [sys.executable, "-c", SERVER, str(study.path), "0"],
            capture_output=True,
            text=True,
        )
    assert "are being written already" in done.stderr
