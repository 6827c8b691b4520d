# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a program of Far-LoD, passes its progress on, and ends it when the user cancels. Needs no QGIS."""
from __future__ import annotations

import os
import queue
import re
import subprocess
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol

# Seconds. What a program says is looked at so often; one that is told to end gets this long
POLL_S, GRACE_S = 0.1, 5.0
# console/progress.cpp: "far maps: 40 %, about 3 s left"
PROGRESS = re.compile(r"(?P<stage>[^:]+): (?P<percent>\d+) %, about (?P<left>.+) left")
# On a terminal, a progress line is drawn again: after a carriage return, and this, which clears the line
LINE_BREAK, CLEAR_LINE = re.compile(rb"[\r\n]"), b"\x1b[K"


class Listener(Protocol):
    """What of QgsProcessingFeedback is used here."""

    def isCanceled(self) -> bool: ...

    def setProgress(self, percent: float) -> None: ...

    def setProgressText(self, text: str) -> None: ...

    def pushWarning(self, text: str) -> None: ...


class ProgramFailed(Exception):
    """What the program said, and its exit code."""

    def __init__(self, message: str, exit_code: int) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class Cancelled(Exception):
    """The user has cancelled the run, and the program has ended."""


def run_program(command: Sequence[str], listener: Listener) -> list[str]:
    """The lines of the program's standard output. Raises ProgramFailed when it fails, Cancelled when the user cancels."""
    said = _Said(listener)
    with _StandardError() as standard_error:
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": standard_error.for_program}
        with subprocess.Popen(command, **streams, **_without_window()) as process:
            standard_error.close_for_program()
            assert process.stdout is not None
            _listen(process, {process.stdout.fileno(): said.output, standard_error.for_us: said.error}, listener)
    if process.returncode != 0:
        message = "\n".join(said.error_lines) or f"{os.path.basename(command[0])} ended with exit code {process.returncode}"
        raise ProgramFailed(message, process.returncode)
    for line in said.error_lines:
        listener.pushWarning(line)
    return said.output_lines


class _Said:
    """Sorts what a program says into results, progress, and messages."""

    def __init__(self, listener: Listener) -> None:
        self.output_lines: list[str] = []
        self.error_lines: list[str] = []
        self._listener = listener
        self._stage = ""

    def output(self, line: str) -> None:
        self.output_lines.append(line)

    def error(self, line: str) -> None:
        progress = PROGRESS.fullmatch(line)
        if progress is None:
            self.error_lines.append(line)
            return
        if progress["stage"] != self._stage:
            self._stage = progress["stage"]
            self._listener.setProgressText(self._stage)
        self._listener.setProgress(float(progress["percent"]))


class _StandardError:
    """A pseudo-terminal where there are any: on one, the programs tell their progress five times a second, else every 10 s."""

    def __init__(self) -> None:
        try:
            import tty

            self.for_us, self.for_program = os.openpty()
            tty.setraw(self.for_program)
        except (ImportError, AttributeError, OSError):
            self.for_us, self.for_program = os.pipe()
        self._open = [self.for_us, self.for_program]

    def __enter__(self) -> _StandardError:
        return self

    def close_for_program(self) -> None:
        """Our copy; the end of the stream comes when the program closes its own."""
        self._open.remove(self.for_program)
        os.close(self.for_program)

    def __exit__(self, *exception: object) -> None:
        for descriptor in self._open:
            os.close(descriptor)


def _without_window() -> dict[str, int]:
    """On Windows, a program of the console opens a window of its own unless it is told not to."""
    return {"creationflags": subprocess.CREATE_NO_WINDOW} if os.name == "nt" else {}


def _lines_of(descriptor: int) -> Iterator[str]:
    rest = b""
    while True:
        try:
            block = os.read(descriptor, 65536)
        except OSError:  # how Linux tells that the other end of a pseudo-terminal is closed
            block = b""
        *lines, rest = LINE_BREAK.split(rest + block) if block else [rest, b""]
        texts = (line.replace(CLEAR_LINE, b"").decode("utf-8", "replace").rstrip() for line in lines)
        yield from (text for text in texts if text)
        if not block:
            return


def _listen(process: subprocess.Popen, streams: dict[int, Callable[[str], None]], listener: Listener) -> None:
    """The listener is called from this thread alone, as QGIS wants it; other threads read the streams."""
    arrived: queue.Queue = queue.Queue()

    def read(descriptor: int) -> None:
        for line in _lines_of(descriptor):
            arrived.put((streams[descriptor], line))
        arrived.put(None)

    threads = [threading.Thread(target=read, args=(descriptor,), daemon=True) for descriptor in streams]
    for thread in threads:
        thread.start()
    try:
        _take_lines(arrived, len(threads), listener)
    except BaseException:
        _end(process)
        raise
    finally:
        process.wait()
        for thread in threads:
            thread.join()


def _take_lines(arrived: queue.Queue, open_streams: int, listener: Listener) -> None:
    while open_streams > 0:
        if listener.isCanceled():
            raise Cancelled
        try:
            entry = arrived.get(timeout=POLL_S)
        except queue.Empty:
            continue
        if entry is None:
            open_streams -= 1
        else:
            take, line = entry
            take(line)


def _end(process: subprocess.Popen) -> None:
    process.terminate()
    try:
        process.wait(GRACE_S)
    except subprocess.TimeoutExpired:
        process.kill()
