"""Outputs that cannot be written, in every command and form."""
import fcntl
import os
import subprocess
import time
from pathlib import Path

import tool
from tool import CAMERA, FaultTest, run, untroubled


def many_points(count):
    return b"".join(b'{"id":%d,"x":1,"y":%d,"z":3}\n' % (i, i % 7) for i in range(count))


class Outputs(FaultTest):
    def test_without_a_fault_all_goes_well(self):
        def check(arguments, given):
            done = untroubled(arguments, given)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotEqual(done.stdout, b"")
            if arguments[0] != "measure":
                self.assertEqual(done.stderr, b"")

        self.each_run(check)

    def test_a_full_device_is_one_message_and_status_1(self):
        def check(arguments, given):
            with open("/dev/full", "wb") as full:
                done = run(arguments, given, stdout=full)
            self.assertEqual(done.returncode, tool.failure(arguments))
            self.assertTrue(done.stderr.endswith(b"viewproj: standard output: No space left on device\n"), done.stderr)

        self.each_run(check)

    def test_messages_that_cannot_be_written_change_nothing_else(self):
        def check(arguments, given):
            told = untroubled(arguments, given)
            with open("/dev/full", "wb") as full:
                untold = run(arguments, given, stderr=full)
            self.assertEqual(untold.returncode, told.returncode)
            if arguments[0] != "measure":
                self.assertEqual(untold.stdout, told.stdout)

        self.each_run(check)

    def test_a_pipe_without_a_reader_ends_quietly(self):
        def check(arguments, given):
            reader, writer = os.pipe()
            os.close(reader)
            done = run(arguments, given, stdout=writer)
            os.close(writer)
            self.assertEqual(done.returncode, 0)
            self.assertNotIn(b"standard output", done.stderr)

        self.each_run(check)

    def test_a_pipe_without_a_reader_ends_what_waits_for_input(self):
        """Workers wait for more of it when another finds that nobody reads, or that a record is bad."""
        runs = []
        arguments = ["project", "-c", CAMERA, "--jobs", "4", "--from", "text", "--to", "ndjson"]
        for lines in range(20000, 32000, 4000):  # who waits where is chance
            for last in ("0 0 2", "0 0"):
                feed = ["sh", "-c", f"yes 0 0 2 | head -n {lines}; echo {last}; exec sleep 60"]
                feeder = subprocess.Popen(feed, stdout=subprocess.PIPE)
                process = self.started(arguments, stdin=feeder.stdout, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.addCleanup(feeder.wait)
                self.addCleanup(feeder.kill)
                feeder.stdout.close()
                runs.append((process, lines, last))
        for process, lines, last in runs:
            with self.subTest(lines=lines, last=last):
                tool.wait_until_still(process)
                if last == "0 0":
                    out, err = process.communicate(timeout=10)
                    self.assertEqual((process.returncode, out.count(b"\n")), (1, lines))
                    self.assertTrue(err.startswith(b"viewproj: <stdin>:%d:" % (lines + 1)) and tool.is_one_message(err), err)
                else:
                    process.stdout.close()
                    self.assertEqual((process.wait(10), process.stderr.read()), (0, b""))

    def test_a_closed_standard_output_is_one_message_and_status_1(self):
        def check(arguments, given):
            done = run(arguments, given, before=lambda: os.close(1))
            self.assertEqual((done.stdout, done.returncode), (b"", tool.failure(arguments)))
            self.assertTrue(done.stderr.endswith(b"viewproj: standard output: Bad file descriptor\n"), done.stderr)

        self.each_run(check)

    def test_a_closed_standard_error_changes_nothing_else(self):
        def check(arguments, given):
            told = untroubled(arguments, given)
            untold = run(arguments, given, before=lambda: os.close(2))
            self.assertEqual(untold.returncode, told.returncode)
            if arguments[0] != "measure":
                self.assertEqual(untold.stdout, told.stdout)

        self.each_run(check)

    def test_files_are_not_taken_for_closed_descriptors(self):
        points = self.file("points.csv", tool.POINTS["csv"])
        camera = self.file("camera.json", CAMERA)
        kept = Path(points).read_bytes(), Path(camera).read_bytes()
        arguments = ["project", "-c", camera, points]
        for closed in ((0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)):
            with self.subTest(closed):
                done = run(arguments, stdin=subprocess.DEVNULL, before=lambda: [os.close(i) for i in closed])
                self.assertEqual(done.returncode, 1 if 1 in closed else 0)
                self.assertEqual((Path(points).read_bytes(), Path(camera).read_bytes()), kept)

    def test_every_stage_of_a_pipeline_ends_quietly_behind_its_reader(self):
        self.file("camera.json", CAMERA)
        self.file("many.ndjson", many_points(30000))
        ray = '"$VIEWPROJ_TOOL" ray -c camera.json --jobs 4'
        for jobs in ("1", "4"):
            for form in ("ndjson", "json", "csv", "text", "f64"):
                program = f'"$VIEWPROJ_TOOL" project -c camera.json --jobs {jobs}'
                project = f"{program} --to {form}"
                reader = "head -c 24" if form == "f64" else "head -n 1"
                for line in (
                    f"{project} many.ndjson; echo project $? >&2",
                    f"yes '[1,2,3]' | {{ {project}; echo project $? >&2; }}",
                    f"{{ {program} --to ndjson many.ndjson; echo project $? >&2; }} | {{ {ray} --to {form}; echo ray $? >&2; }}",
                ):
                    with self.subTest(line):
                        done = subprocess.run(
                            ["sh", "-c", f"{{ {line}; }} | {reader}"],
                            capture_output=True,
                            timeout=tool.PATIENCE,
                            env={**os.environ, "VIEWPROJ_TOOL": tool.TOOL},
                            check=False,
                        )
                        self.assertIn(sorted(done.stderr.split()), ([b"0", b"project"], [b"0", b"0", b"project", b"ray"]))
                        self.assertNotEqual(done.stdout, b"")


class SlowReaders(FaultTest):
    """Pipes that take little at a time, blocking and not."""

    def through(self, arguments, given, nonblocking, pipe_size, pause, descriptor=1):
        """What comes through a pipe of that size to a reader that pauses now and then."""
        reader, writer = os.pipe()
        fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, pipe_size)
        if nonblocking:
            os.set_blocking(writer, False)
        with open(given, "rb") as points:
            streams = {"stdin": points, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            streams["stdout" if descriptor == 1 else "stderr"] = writer
            process = tool.start(arguments, **streams)
        os.close(writer)
        pieces = []
        while piece := os.read(reader, 5000):
            pieces.append(piece)
            if len(pieces) % 50 == 0:
                time.sleep(pause)
        os.close(reader)
        return process.wait(tool.PATIENCE), b"".join(pieces)

    def test_a_pipe_that_does_not_block_loses_nothing(self):
        given = self.file("many.ndjson", many_points(3000))
        with open(given, "rb") as points:
            expected = run(["project", "-c", CAMERA], points.read()).stdout
        for nonblocking in (False, True):
            for jobs in ("1", "4"):
                with self.subTest(nonblocking=nonblocking, jobs=jobs):
                    status, out = self.through(
                        ["project", "-c", CAMERA, "--jobs", jobs], given, nonblocking, 4096, 0.005
                    )
                    self.assertEqual(status, 0)
                    self.assertTrue(out == expected)

    def test_documents_pass_a_pipe_that_does_not_block(self):
        given = self.file("many.ndjson", many_points(600))
        arguments = ["draw", "-c", CAMERA]
        with open(given, "rb") as points:
            expected = run(arguments, points.read()).stdout
        self.assertGreater(len(expected), 20000)
        self.assertEqual(self.through(arguments, given, True, 4096, 0.005), (0, expected))

    def test_messages_pass_a_pipe_that_does_not_block(self):
        given = self.file("bad.ndjson", b"[1,2]\n" * 2000)
        status, err = self.through(["project", "-c", CAMERA, "--keep-going"], given, True, 4096, 0.005, descriptor=2)
        self.assertEqual(status, 1)
        self.assertEqual(err.count(b"\n"), 2000)
        for number, line in enumerate(err.splitlines(), 1):
            self.assertTrue(line.startswith(b"viewproj: <stdin>:%d:1: " % number), line)

    def test_input_byte_by_byte_gives_the_same(self):
        """Once for each command from a pipe that does not block, too."""
        waited = set()

        def check(arguments, given):
            if not given:
                return
            expected = untroubled(arguments, given)
            waits = arguments[0] not in waited
            waited.add(arguments[0])
            for nonblocking in (False, True) if waits else (False,):
                reading, writing = os.pipe()
                os.set_blocking(reading, not nonblocking)
                process = tool.start(arguments, stdin=reading, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                os.close(reading)
                if nonblocking:
                    tool.wait_until_still(process)
                for i in range(len(given)):
                    os.write(writing, given[i : i + 1])
                    if nonblocking and i % 20 == 0:
                        time.sleep(0.001)
                os.close(writing)
                out, err = process.communicate(timeout=tool.PATIENCE)
                self.assertEqual((process.returncode, out, err), (0, expected.stdout, b""))

        self.each_run(check, lambda arguments: arguments[0] != "measure")


if __name__ == "__main__":
    tool.main()
