"""Calls of the system that fail, one after the other: memory, descriptors, reads and writes, threads.

VIEWPROJ_FAULT_ALL=1 in the environment: every allocation, where a sample is tried otherwise.
"""
import errno
import functools
import os
import unittest

import tool
from tool import FaultTest, RUNS, run

LIBRARY = os.environ["VIEWPROJ_FAULT_LIBRARY"]
MOST_A_RUN = 10**9 if "VIEWPROJ_FAULT_ALL" in os.environ else 3


@functools.cache
def counted():
    """Every run without a fault: its arguments and input, what it does, and how often it makes which call."""
    found = []
    for arguments, given in RUNS:
        counts = {"LD_PRELOAD": LIBRARY, "VIEWPROJ_FAULT_COUNTS": "counts"}
        done = run(arguments, given, env={**os.environ, **counts})
        with open("counts", encoding="ascii") as lines:
            found.append((arguments, given, done, {call: int(count) for call, count in map(str.split, lines)}))
    return found


def faulty(arguments, given, call, number, kind):
    fault = {"LD_PRELOAD": LIBRARY, "VIEWPROJ_FAULT": f"{call} {number} {kind}"}
    return run(arguments, given, env={**os.environ, **fault})


@unittest.skipIf(tool.SANITIZED, "a sanitizer allocates in its own way")
class Calls(FaultTest):
    def each_call(self, call, check, wanted=lambda arguments: True):
        """check(arguments, given, number, expected) for the calls of that name in every run; expected: without fault."""
        tried = 0
        seen = 0
        for arguments, given, expected, counts in counted():
            if not wanted(arguments):
                continue
            calls = counts[call]
            step = max(1, calls // MOST_A_RUN)
            seen += 1
            for number in range(1 + seen % step, calls + 1, step):
                tried += 1
                with self.subTest(f"{call} {number} of {calls}: {' '.join(arguments)}"):
                    check(arguments, given, number, expected)
        self.assertGreater(tried, 20)

    def assert_same(self, arguments, done, expected):
        self.assertEqual(done.returncode, 0, done.stderr)
        if arguments[0] != "measure":
            self.assertEqual((done.stdout, done.stderr), (expected.stdout, expected.stderr))

    def assert_whole_records(self, arguments, out, expected):
        """What was written is what would have been, up to the end of a record."""
        if arguments[0] == "measure" or expected.startswith(out):
            if tool.is_stream(arguments):
                binary = tool.is_binary(arguments) and out
                self.assertTrue(len(expected) % len(out) == 0 if binary else out[-1:] in (b"", b"\n", b"[", b"}"), out)
            return
        self.assertTrue(out.endswith(b"\n]\n") and expected.startswith(out[:-3]), out)

    def test_memory_that_is_not_to_be_had_is_one_message_and_status_1(self):
        def check(arguments, given, number, expected):
            for kind in (f"{errno.ENOMEM}", f"{errno.ENOMEM}+"):
                done = faulty(arguments, given, "malloc", number, kind)
                if done.returncode == 0:
                    self.assert_same(arguments, done, expected)
                else:
                    self.assertEqual(done.returncode, tool.failure(arguments))
                    self.assertEqual(done.stderr, b"viewproj: out of memory\n")
                    self.assert_whole_records(arguments, done.stdout, expected.stdout)

        self.each_call("malloc", check)

    def test_interrupted_and_short_calls_change_nothing(self):
        for call, kinds in (
            ("read", (errno.EINTR, errno.EAGAIN, "short", "short+")),
            ("write", (errno.EINTR, errno.EAGAIN, "short", "short+")),
            ("poll", (errno.EINTR,)),
        ):

            def check(arguments, given, number, expected):
                for kind in kinds:
                    self.assert_same(arguments, faulty(arguments, given, call, number, kind), expected)

            self.each_call(call, check, (lambda arguments: True) if call in ("read", "write") else tool.is_stream)

    def test_an_input_that_cannot_be_read_on_is_one_message_and_status_1(self):
        def check(arguments, given, number, expected):
            done = faulty(arguments, given, "read", number, f"{errno.EIO}+")
            self.assert_fails(done, "<stdin>: Input/output error", tool.failure(arguments))
            self.assert_whole_records(arguments, done.stdout, expected.stdout)

        self.each_call("read", check)

    def test_an_output_that_cannot_be_written_on_is_one_message_and_status_1(self):
        def check(arguments, given, number, expected):
            for kind, message in ((errno.EIO, "Input/output error"), (errno.EDQUOT, "Disk quota exceeded")):
                done = faulty(arguments, given, "write", number, f"{kind}+")
                self.assertEqual(done.returncode, tool.failure(arguments))
                self.assertTrue(done.stderr.endswith(f"viewproj: standard output: {message}\n".encode()), done.stderr)
                self.assertTrue(arguments[0] == "measure" or expected.stdout.startswith(done.stdout))

        self.each_call("write", check)

    def test_descriptors_that_are_not_to_be_had_are_one_message_and_status_1(self):
        camera = self.file("camera.json", tool.CAMERA)
        points = self.file("points.json", tool.POINTS["json"])
        done = faulty(["project", "-c", camera, points], b"", "open", 1, errno.EMFILE)
        self.assert_fails(done, "camera.json: Too many open files")
        done = faulty(["project", "-c", camera, points], b"", "open", 2, errno.ENFILE)
        self.assert_fails(done, "points.json: Too many open files in system")

    def test_without_threads_fewer_do_the_work(self):
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 40000)
        arguments = ["project", "-c", tool.CAMERA, "--jobs", "6", many]
        expected = run(arguments)
        self.assert_goes_well(expected)
        for number in range(1, 6):
            done = faulty(arguments, b"", "thread", number, f"{errno.EAGAIN}+")
            self.assert_same(arguments, done, expected)


if __name__ == "__main__":
    tool.main()
