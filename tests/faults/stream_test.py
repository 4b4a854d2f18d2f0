"""Streams in time: what is written when, by how many threads, in how much memory, and what a terminal shows of it."""
import os
import pty
import re
import select
import subprocess
import time
import unittest
from pathlib import Path

import tool
from tool import CAMERA, POINTS, FaultTest

F64 = POINTS["f64"]


def status(process, name):
    """A number that the system has of a running process."""
    return int(re.search(rf"^{name}:\s*(\d+)", Path(f"/proc/{process.pid}/status").read_text(), re.M)[1])


def answer(process, size):
    """So many bytes, or a line for 0; less where no more comes."""
    text = b""
    while len(text) < size if size else not text.endswith(b"\n"):
        if not select.select([process.stdout], [], [], tool.PATIENCE)[0]:
            break
        text += os.read(process.stdout.fileno(), 1)
    return text


class Streams(FaultTest):
    def start(self, arguments, **more):
        return self.started(["project", "-c", CAMERA, *arguments], stdout=subprocess.PIPE, **more)

    def test_a_record_is_answered_before_the_next_one_is_there(self):
        for arguments, said, size in (
            (["--jobs", "4"], (b"[1,2,3]\n", b'{"x":1,\n"y":2,"z":3}\n', b"[1,2,3]\n"), 0),
            ([], (b"[1,2,3]", b"[1,2,3]"), 0),
            (["--from", "json"], (b"[1,2,3]", b"[1,2,3]", b' {"x":1,"y":2,"z":3}'), 0),
            (["--to", "ndjson"], (b"[[1,2,3]", b",[1,2,3]", b",\n[1,2,3]", b",[1,2,3]]"), 0),
            (["--to", "json"], (b"[1,2,3]\n",), 20),
            ([], (b"x,y,z\n", b"1,2,3\n", b'"1",2,3\n'), 0),
            (["--to", "csv"], (b"1 2 3\n", b"1 2 3\n"), 0),
            (["--from", "f64"], (F64, F64), 24),
            (["--from", "text"], (b"1 2 3\n", b"1 2 3\r\n"), 0),
        ):
            with self.subTest(f"{arguments} {said[0]}"):
                process = self.start(arguments, stdin=subprocess.PIPE, bufsize=0)
                for text in said:
                    process.stdin.write(text)
                    self.assertGreater(len(answer(process, size)), 2, text)
                process.stdin.close()
                self.assertEqual(process.wait(tool.PATIENCE), 0)

    def test_a_reader_that_sleeps_costs_no_memory(self):
        """And workers are started for much input, from a pipe or a file."""
        many = self.file("many.ndjson", b"[1,2,33]\n" * 100000)
        with open(many, "rb") as file:
            feeder = subprocess.Popen(["yes", "[1,2,33]"], stdout=subprocess.PIPE)
            for source in (feeder.stdout, file):
                process = self.start(["--from", "json", "--jobs", "4"], stdin=source)
                tool.wait_until_still(process)
                if not tool.SANITIZED:
                    self.assertEqual(status(process, "Threads"), min(4, len(os.sched_getaffinity(0))))
                    self.assertLess(status(process, "VmHWM"), 32 << 10)
                process.kill()
            feeder.stdout.close()
            feeder.wait(tool.PATIENCE)

    @unittest.skipIf(tool.SANITIZED, "a sanitizer has a thread of its own")
    def test_no_workers_are_started_for_a_little_at_a_time(self):
        process = self.start(["--from", "json", "--jobs", "4"], stdin=subprocess.PIPE, bufsize=0)
        for count in (1000, *[1] * 20):
            process.stdin.write(b"[1,2,33]\n" * count)
            for _ in range(count):
                process.stdout.readline()
        self.assertEqual(status(process, "Threads"), 1)


class Progress(FaultTest):
    def shown(self, terminal):
        """All that it shows once nobody writes there any more."""
        text = b""
        try:
            while part := os.read(terminal, 1 << 16):
                text += part
        except OSError:
            pass
        os.close(terminal)
        return text

    def test_it_is_told_on_a_terminal_alone_after_a_second_and_taken_away(self):
        runs = []
        for out_is_terminal, pieces in ((False, 14), (False, 5), (True, 14)):
            shows, terminal = pty.openpty()
            process = tool.start(
                ["project", "-c", CAMERA],
                stdin=subprocess.PIPE,
                stdout=terminal if out_is_terminal else subprocess.DEVNULL,
                stderr=subprocess.PIPE if out_is_terminal else terminal,
            )
            os.close(terminal)
            runs.append((process, shows, pieces))
        for piece in range(14):
            for process, _, pieces in runs:
                if piece < pieces:
                    process.stdin.write(b"[1,2,3]\n")
                    process.stdin.flush()
                elif piece == pieces:
                    process.stdin.close()
            time.sleep(0.1)
        (told, shows, _), (short, shows_nothing, _), (elsewhere, shows_records, _) = runs
        told.stdin.close()
        elsewhere.stdin.close()
        self.assertRegex(self.shown(shows), rb"records, .* records/s.*\r\x1b\[K$")
        self.assertEqual(self.shown(shows_nothing), b"")
        self.assertNotIn(b"records", self.shown(shows_records))
        self.assertEqual(elsewhere.stderr.read(), b"")
        elsewhere.stderr.close()
        self.assertEqual([process.wait(tool.PATIENCE) for process in (told, short, elsewhere)], [0, 0, 0])

    def test_it_tells_the_share_that_is_done(self):
        """Of a file of f64, which gives as many bytes as it has."""
        size = 24 << 20
        with open("half.f64", "wb") as file:
            file.truncate(size)
        end, terminal = pty.openpty()
        process = tool.start(["project", "-c", CAMERA, "half.f64"], stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        begun = time.monotonic()
        read = 0
        while read < size * 6 // 10:
            read += len(os.read(process.stdout.fileno(), 1 << 16))
        time.sleep(max(0, begun + 1.1 - time.monotonic()))
        shown = b""
        while b"records/s" not in shown and read < size:
            read += len(os.read(process.stdout.fileno(), 1 << 14))
            if select.select([end], [], [], 0.01)[0]:
                shown += os.read(end, 1000)
        process.kill()
        process.communicate()
        os.close(end)
        self.assertRegex(shown, rb"\d+ %, .* records/s")
        percent = int(re.search(rb"(\d+) %", shown)[1])
        self.assertTrue(50 <= percent <= 100, percent)


if __name__ == "__main__":
    tool.main()
