"""Finds the program, checks its version, and runs it: progress, Ctrl-C, and errors with the program's line."""
from __future__ import annotations

import codecs
import contextlib
import functools
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import threading
import tty
from collections.abc import Callable, Collection, Iterator, Sequence

from .parameters import program_version

bundled = pathlib.Path(__file__).resolve().parent / "program" / "umbrameter"  # in a wheel that carries the program
erase_line = "\r\x1b[K"  # what the program writes before each state of its progress bar
end_mark = b"\x00"  # what this package writes behind the last line of the program


class Error(RuntimeError):
    """What the program refused or could not do; the message is the program's line.

    `exit_code` is 1 where a check failed, 2 for usage or configuration, 3 without usable OpenGL or Embree, 4 for
    unreadable input, 5 for a partial result, and None where the program did not run or goes on.
    """

    def __init__(self, line: str, exit_code: int | None = None, command: Sequence[str] = ()) -> None:
        super().__init__(line)
        self.exit_code = exit_code
        self.command = list(command)


def find_program() -> pathlib.Path:
    """Path of the program: `UMBRAMETER`, else the one of a wheel that carries it, on PATH, or in the prefix of Python.

    Raises Error if there is none, or if its major or minor version is not that of this package.
    """
    chosen = os.environ.get("UMBRAMETER")
    prefixes = [pathlib.Path(sys.prefix), *pathlib.Path(__file__).resolve().parents, pathlib.Path("/usr/local")]
    places = [chosen] if chosen else [str(bundled), "umbrameter", *(str(prefix / "bin" / "umbrameter") for prefix in prefixes)]
    found = next((where for place in places if (where := shutil.which(place))), None)
    if found is None:
        sought = f"UMBRAMETER names {chosen}, which is no program" if chosen else "neither on PATH nor in a prefix"
        raise Error(f"umbrameter: program not found: {sought}; set UMBRAMETER to its path")
    path = pathlib.Path(found)
    version = _version_of(path, path.stat().st_mtime_ns)
    if version.split(".")[:2] != program_version.split(".")[:2]:
        raise Error(f"{path} is version {version or 'unknown'}, this package is for {program_version}: "
                    "install the package of the program's version")
    return path


def run_bundled() -> None:
    """Become the program that the wheel carries: its console script."""
    os.execv(bundled, ["umbrameter", *sys.argv[1:]])


@functools.lru_cache(maxsize=8)
def _version_of(path: pathlib.Path, _changed: int) -> str:
    try:
        text = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=60).stdout
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Error(f"{path}: cannot be run: {error}; set UMBRAMETER to the program's path") from error
    words = text.split()
    return words[1] if len(words) == 2 and words[0] == "umbrameter" else ""


def run(arguments: Sequence[str], progress: bool | None = None, exit_codes: Collection[int] = (0,)) -> str:
    """Run the program and return what it prints on stdout.

    `progress` shows its bar and notes on `sys.stderr`; None: in a terminal and in a notebook. Ctrl-C stops the program,
    waits until it has stored what it has, and raises KeyboardInterrupt; a second one ends it at once.
    Raises Error with the program's line for any other exit code than `exit_codes`.
    """
    pressed: list[int] = []
    program: Program | None = None

    def stop(*_: object) -> None:
        pressed.append(signal.SIGKILL if pressed else signal.SIGINT)
        if program is not None:
            program.process.send_signal(pressed[-1])

    printed: list[bytes] = []
    with _on_interrupt(stop):
        program = Program(arguments, subprocess.DEVNULL, progress)
        if pressed:  # while it started
            program.process.send_signal(signal.SIGINT)
        assert program.process.stdout is not None
        read = program.process.stdout.read
        reader = threading.Thread(target=lambda: printed.append(read()), daemon=True)
        reader.start()
        exit_code = program.process.wait()
        reader.join()
        program.close()
    if pressed:
        raise KeyboardInterrupt
    answer = b"".join(printed).decode()
    if exit_code not in exit_codes:
        raise program.error(answer if exit_code == 1 else "")
    return answer


class Program:
    """The program while it runs: shows its progress, and keeps its lines for an Error."""

    def __init__(self, arguments: Sequence[str], stdin: int, progress: bool | None) -> None:
        """`stdin` is subprocess.DEVNULL or PIPE; `progress` is that of run()."""
        self.command = [str(find_program()), *arguments]
        self._lines: list[str] = []
        if progress is None:
            progress = sys.stderr.isatty() or "ipykernel" in sys.modules
        environment = dict(os.environ)
        if progress:
            # The program draws its bar only in a terminal.
            self._ours, theirs = pty.openpty()
            tty.setraw(theirs)
            environment.update(TERM="xterm", NO_COLOR="1")
        else:
            self._ours, theirs = os.pipe()
        self._theirs = theirs
        # Its own process group: Ctrl-C of a terminal would reach the program twice, and the second signal ends it at once.
        self.process = subprocess.Popen(self.command, stdin=stdin, stdout=subprocess.PIPE, stderr=theirs, env=environment,
                                        process_group=0)
        self._follower = threading.Thread(target=_follow, args=(self._ours, self._lines, _show if progress else None),
                                          daemon=True)
        self._follower.start()

    def close(self) -> None:
        """Close its pipes, after it has ended."""
        # A pseudo-terminal whose last writer is gone may end before its last line was read.
        os.write(self._theirs, end_mark)
        self._follower.join()
        os.close(self._theirs)
        os.close(self._ours)
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):  # what was not written yet
                    pipe.close()

    def error(self, answer: str = "") -> Error:
        """Why it ended: its line. A check that fails says so in the last line of its answer."""
        exit_code = self.process.returncode
        refusals = [line for line in self._lines if line.startswith("umbrameter: ")] or answer.splitlines() or self._lines
        return Error(refusals[-1] if refusals else f"umbrameter ended with exit code {exit_code}", exit_code, self.command)


@contextlib.contextmanager
def _on_interrupt(handler: Callable[..., None]) -> Iterator[None]:
    """Ctrl-C calls the handler; it reaches only the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _follow(descriptor: int, lines: list[str], show: Callable[[str, str], None] | None) -> None:
    """Collect the lines of stderr, and show them and the bar between them. An error's line is left to the exception."""
    decode = codecs.getincrementaldecoder("utf-8")("replace").decode
    rest = ""
    has_ended = False
    while not has_ended:
        chunk = os.read(descriptor, 4096)
        has_ended = chunk.endswith(end_mark)
        *complete, rest = (rest + decode(chunk.removesuffix(end_mark))).split("\n")
        for line in (each.rpartition(erase_line)[2] for each in complete):
            lines.append(line)
            if show and not line.startswith("umbrameter: "):
                show(line, "\n")
        if erase_line in rest:
            rest = erase_line + rest.rpartition(erase_line)[2]
            if show:
                show(rest.removeprefix(erase_line), "")


def _show(text: str, end: str) -> None:
    """In place of the bar that stands there. Notebooks know no escape sequence but the carriage return."""
    with contextlib.suppress(OSError, ValueError):
        sys.stderr.write((erase_line + text if sys.stderr.isatty() else "\r" + text.ljust(100)) + end)
        sys.stderr.flush()
