"""Build wheel and sdist, and try them as a user has them: without the repository.

usage: check_release.py [--out DIR] [--python PYTHON] [--limit N]

Compares the files of both with the repository's; installs the wheel into a virtual
environment outside it, with an empty home; runs the commands of README.md there, each on a few
episodes; and has pyright check a user's program against the installed package.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
LARGEST = 40 * 2**20
"""Bytes of the wheel, and of the sdist."""
LEFT_OUT = {
    r"^make |^source |pip install -e": "of the repository",
    r"^pip install|^memorymaze benchmark$": "done before",
    r"--model |replies\.jsonl": "asks a language model",
    r"memorymaze (try|study|sites edit)\b": "serves pages; extra studies",
    r"memorymaze replay\b": "needs graphics; extra video",
}
"""Commands of README.md that are not tried, as patterns, and why."""
SHORTER = {
    r" --limit \d+": "",
    r" --count \d+": " --count 1",
    r" --buildings \d+ --per-route \d+": " --buildings 4 --per-route 1",
}
"""What is made smaller, as patterns."""
RIGHT = """
import memorymaze as mm
from memorymaze.world.sites import load_sites

run = mm.evaluate(RightHand(), limit=1, out="runs/typed")
table: mm.Table = run.table()
names: list[str] = sorted(load_sites())
"""
WRONG = "\nlength: str = mm.load_corpus().episodes[0].goal[0]\n"
"""A mistake that is found only where the package's types are seen."""


class ReleaseProblem(Exception):
    """Something that must not be released."""


def main() -> int:
    """Check everything; say what was found and, last, what was wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=PROJECT / "dist", metavar="DIR")
    parser.add_argument("--python", default=sys.executable, help="who runs the wheel")
    parser.add_argument("--limit", type=int, default=2, help="episodes of a command")
    options = parser.parse_args()
    try:
        wheel, sdist = build(options.out)
        check_files(wheel, sdist)
        with tempfile.TemporaryDirectory(prefix="release-") as folder:
            user = User(Path(folder), options.python)
            user.install(wheel)
            user.try_readme(options.limit)
            user.check_types()
    except ReleaseProblem as problem:
        print(f"check_release: {problem}", file=sys.stderr)
        return 1
    print(f"{wheel.name} and {sdist.name} can be released")
    return 0


def build(out: Path) -> tuple[Path, Path]:
    """Build the sdist, and the wheel from that, into a folder that holds nothing else."""
    shutil.rmtree(out, ignore_errors=True)
    command = [sys.executable, "-m", "build", "--outdir", str(out), str(PROJECT)]
    call(command, PROJECT)
    [wheel], [sdist] = out.glob("*.whl"), out.glob("*.tar.gz")
    return wheel, sdist


def check_files(wheel: Path, sdist: Path) -> None:
    """Compare size, names and bytes with the repository; and the version in its papers."""
    for archive in (wheel, sdist):
        if archive.stat().st_size > LARGEST:
            raise ReleaseProblem(
                f"{archive.name}: expected at most {LARGEST / 2**20:.0f} MiB, got "
                f"{archive.stat().st_size / 2**20:.1f}"
            )
        print(f"{archive.name}: {archive.stat().st_size / 2**20:.1f} MiB")
    tracked = call(["git", "ls-files", "-z"], PROJECT).split("\0")[:-1]
    package = [name for name in tracked if name.startswith("src/memorymaze/")]
    with zipfile.ZipFile(wheel) as packed:
        inside = {name for name in packed.namelist() if ".dist-info/" not in name}
        compare(wheel.name, inside, {name.removeprefix("src/") for name in package})
        for name in package:
            if packed.read(name.removeprefix("src/")) != (PROJECT / name).read_bytes():
                raise ReleaseProblem(
                    f"{wheel.name}: {name} differs from the repository's"
                )
    with tarfile.open(sdist) as packed:
        names = {each.name.partition("/")[2] for each in packed if each.isfile()}
        compare(sdist.name, names - {"PKG-INFO"}, set(tracked))
    version = wheel.name.split("-")[1]
    for paper, line in (("CITATION.cff", "version: {}"), ("CHANGELOG.md", "## {} ")):
        if f"\n{line.format(version)}" not in (PROJECT / paper).read_text("utf-8"):
            raise ReleaseProblem(f"{paper}: expected a line for version {version}")


def compare(archive: str, inside: set[str], expected: set[str]) -> None:
    """Refuse an archive that lacks files or has others than the repository's."""
    wrong = [f"lacks {name}" for name in sorted(expected - inside)]
    wrong += [f"has {name}, which git does not track" for name in inside - expected]
    if wrong:
        raise ReleaseProblem("\n  ".join([f"{archive}:", *wrong]))
    print(f"{archive}: {len(inside)} files, those of the repository")


class User:
    """Somebody with the wheel, in an empty home."""

    def __init__(self, folder: Path, python: str) -> None:
        """Make a virtual environment in a folder outside the repository."""
        self.home = folder / "home"
        self.home.mkdir()
        self.bin = folder / "venv" / "bin"
        call([python, "-m", "venv", str(folder / "venv")], folder)

    def install(self, wheel: Path) -> None:
        """Install the wheel alone, with the newest packages that it allows."""
        pip = [str(self.bin / "python"), "-m", "pip", "--disable-pip-version-check"]
        call([*pip, "install", "--quiet", str(wheel)], self.home)
        call([*pip, "check"], self.home)
        self.run("memorymaze --version && memorymaze doctor")

    def try_readme(self, limit: int) -> None:
        """Run the commands of README.md, in order, on few episodes each."""
        readme = (PROJECT / "README.md").read_text(encoding="utf-8")
        agent = self.home / "examples" / "right_hand.py"
        agent.parent.mkdir()
        [program] = re.findall(r"```python\n(import numpy.*?)```", readme, re.DOTALL)
        agent.write_text(program, encoding="utf-8")
        self.run(f"memorymaze benchmark --workers 1 --limit {limit}")
        for command in readme_commands(readme):
            reasons = [
                why for what, why in LEFT_OUT.items() if re.search(what, command)
            ]
            if reasons:
                print(f"left out, {reasons[0]}: {command}")
                continue
            for long, short in SHORTER.items():
                command = re.sub(long, short, command)
            if "memorymaze evaluate" in command:
                command += f" --workers 1 --limit {limit}"
            self.run(command)

    def check_types(self) -> None:
        """Have pyright check a program that is right, and one with a mistake."""
        program = (self.home / "examples" / "right_hand.py").read_text(encoding="utf-8")
        (self.home / "pyrightconfig.json").write_text('{"typeCheckingMode": "strict"}')
        typed = self.home / "typed.py"
        pyright = [sys.executable, "-m", "pyright", "--pythonpath", self.bin / "python"]
        typed.write_text(program + RIGHT, encoding="utf-8")
        call([*map(str, pyright), typed.name], self.home)
        typed.write_text(program + RIGHT + WRONG, encoding="utf-8")
        done = subprocess.run(
            [*map(str, pyright), typed.name],
            cwd=self.home,
            capture_output=True,
            text=True,
        )
        if '"float" is not assignable to "str"' not in done.stdout:
            raise ReleaseProblem(f"pyright does not see the types:\n{done.stdout}")
        print("pyright sees the types of the installed package")

    def run(self, command: str) -> None:
        """Run a command as it is typed; nothing but the environment is on its path."""
        path = f"{self.bin}:/usr/bin:/bin"
        bare = ["env", "-i", f"PATH={path}", f"HOME={self.home}", "LANG=C.UTF-8"]
        call([*bare, "bash", "-c", command], self.home)
        print(f"runs: {command}")


def readme_commands(readme: str) -> Iterator[str]:
    """Yield the commands of the indented blocks, continued lines joined."""
    unquoted = re.sub(r"```.*?```", "", readme, flags=re.DOTALL)
    for block in re.findall(r"(?:^    .*\n)+", unquoted, flags=re.MULTILINE):
        for line in re.sub(r"\\\n +", "", block).splitlines():
            yield re.sub(r"\s+#.*", "", line).strip()


def call(command: list[str], folder: Path) -> str:
    """Run a command in a folder; return what it printed."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise ReleaseProblem(
            f"{' '.join(command)} left code {done.returncode}:\n"
            f"{done.stdout}{done.stderr}"
        )
    return done.stdout


if __name__ == "__main__":
    sys.exit(main())
