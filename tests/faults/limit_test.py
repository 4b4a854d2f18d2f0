"""Little memory, small stacks and files; options at and beyond their ends."""
import resource
import unittest

import tool
from tool import CAMERA, PIXELS, POINTS, FaultTest, run


class Limits(FaultTest):
    @unittest.skipIf(tool.SANITIZED, "a sanitizer takes all the space there is")
    def test_little_memory_is_one_message_or_enough(self):
        """From what the loader needs to plenty."""
        told, well = 0, 0
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 8000)
        big = self.file("big.json", b'["' + b"x" * 6000000 + b'"]')
        for arguments in (
            ["project", "-c", CAMERA, "--jobs", "4", many],
            ["project", "-c", CAMERA, "--jobs", "4", "--to", "table", many],
            ["project", "-c", CAMERA, "--from", "json", big],
            ["measure", "-c", CAMERA, many],
            ["draw", "-c", CAMERA, many],
            ["inspect", big],
            ["matrix", big],
        ):
            expected = run(arguments)
            for mebibytes in (12, 13, 14, 16, 18, 20, 24, 32, 48, 72):
                with self.subTest(f"{arguments} in {mebibytes} MiB"):
                    done = run(arguments, before=tool.limited(resource.RLIMIT_AS, mebibytes << 20))
                    if done.returncode == 127 or b"error while loading" in done.stderr:
                        continue
                    if done.returncode == expected.returncode and b"memory" not in done.stderr:
                        well += 1
                        if arguments[0] != "measure":
                            self.assertEqual((done.stdout, done.stderr), (expected.stdout, expected.stderr))
                        continue
                    told += 1
                    self.assertTrue(done.stderr.endswith(b"viewproj: out of memory\n"), done.stderr)
                    self.assertEqual(done.returncode, 1)
        self.assertGreater(told, 10)
        self.assertGreater(well, 10)

    def test_a_small_stack_is_enough(self):
        def check(arguments, given):
            done = run(arguments, given, before=tool.limited(resource.RLIMIT_STACK, 256 << 10))
            self.assertEqual(done.returncode, 0, done.stderr)

        self.each_run(check)

    def test_a_file_that_may_not_grow_is_one_message_and_status_1(self):
        def check(arguments, given):
            expected = run(arguments, given).stdout
            with open("out", "wb") as out:
                done = run(arguments, given, stdout=out, before=tool.limited(resource.RLIMIT_FSIZE, len(expected) // 2))
            self.assertEqual(done.returncode, tool.failure(arguments))
            self.assertTrue(done.stderr.endswith(b"viewproj: standard output: File too large\n"), done.stderr)
            with open("out", "rb") as out:
                self.assertTrue(expected.startswith(out.read()) or arguments[0] == "measure")

        self.each_run(check)

    def test_jobs_is_a_whole_number_in_range(self):
        for command in ("project", "ray", "cull"):
            given = PIXELS["json"] if command == "ray" else POINTS["json"]
            expected = run([command, "-c", CAMERA], given).stdout
            for value in ("1", "2", "7", "007", "1024"):
                done = run([command, "-c", CAMERA, "--jobs", value], given)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, expected, b""), value)
            for value in ("0", "-1", "-0", "+1", "1025", "9" * 30, "1.5", "1e3", "0x10", "many", "", " ", "1 ", " 1", "nan"):
                done = run([command, "-c", CAMERA, f"--jobs={value}"], given)
                self.assertEqual((done.returncode, done.stdout), (2, b""), value)
                self.assertTrue(tool.is_one_message(done.stderr) and b"--jobs" in done.stderr, done.stderr)

    def test_a_thousand_threads_give_what_one_gives(self):
        many = self.file("many.json", b'{"x":1,"y":2,"z":3}\n' * 60000)
        expected = run(["project", "-c", CAMERA, "--jobs", "1", many])
        done = run(["project", "-c", CAMERA, "--jobs", "1024", many])
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertTrue(done.stdout == expected.stdout)


if __name__ == "__main__":
    tool.main()
