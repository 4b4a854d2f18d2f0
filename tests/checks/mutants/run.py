"""Builds the mutants of tables and runs the tests under each: see README.md."""
import argparse
import concurrent.futures
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path

import mutants

ROOT = Path(__file__).resolve().parents[3]
GOLDEN = ("cmd", "samples")  # tests of single cases
# Neither reads nor runs what a mutation could change, what is tested is the build, or headers alone, without the switch.
LEFT_OUT = ("kernels_share_no_code", "arithmetic", "headers")
MEMORY = 4 << 20  # KiB: who needs them has lost its way
THREADS = ("faults_limit",)  # of which a thousand have more stack
# Random tests are as long as they need be to tell.
SHORTER = {"VIEWPROJ_SHAPE_CASES": "10000", "VIEWPROJ_JSON_LINES": "20000"}


class Suite:
    """The tests of a build, as ctest knows them."""

    def __init__(self, build):
        self.build = build
        listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, check=True)
        self.tests = {test["name"]: test for test in json.loads(listed.stdout)["tests"]}
        self.cases = {name: self._cases(name) for name in GOLDEN}
        self.clean = {}  # by test and part: what it does without a mutant
        self.lock = threading.Lock()

    def _cases(self, name):
        command = self.tests[name]["command"]
        if name == "cmd":
            return subprocess.run([*command, "--list"], capture_output=True, check=True, text=True).stdout.split()
        return sorted(path.parent.name for path in Path(command[-1]).glob("*/cmd"))

    def wrong(self, row):
        for test, part in row.tests:
            if test not in self.tests:
                yield f"{row.where}: there is no test {test}"
            elif test in GOLDEN:
                yield from (f"{row.where}: {test} has no case {case}" for case in part.split() if case not in self.cases[test])

    def rest(self, tried):
        """Every test but those, the golden cases last."""
        yield from ((name, "") for name in self.tests if name not in (*GOLDEN, *LEFT_OUT) and (name, "") not in tried)
        yield from ((name, case) for name in GOLDEN for case in self.cases[name] if (name, case) not in tried)

    def run(self, name, part, number):
        """passed, failed, hangs or skipped under this mutant; what it does without one has been seen before."""
        with self.lock:
            known = self.clean.setdefault((name, part), concurrent.futures.Future())
            first = known.set_running_or_notify_cancel() if not known.running() and not known.done() else False
        if first:
            begun = time.monotonic()
            result, said = self.attempt(name, part, 0, 900)
            known.set_result((result, said, time.monotonic() - begun))
        result, said, seconds = known.result()
        if result not in ("passed", "skipped"):
            raise mutants.BrokenRow(f"without a mutant {name} {part} is no test: {result}\n{said[-4000:]}")
        return self.attempt(name, part, number, max(30, 8 * seconds))[0] if result == "passed" else result

    def attempt(self, name, part, number, patience):
        """The result, and what was printed."""
        test = self.tests[name]
        properties = {entry["name"]: entry["value"] for entry in test["properties"]}
        env = {**os.environ, **SHORTER, "VIEWPROJ_MUTANT": str(number)}
        env.update(entry.split("=", 1) for entry in properties.get("ENVIRONMENT", ()))
        command = [*test["command"], *([part] if part else [])]
        limit = "unlimited" if name in THREADS else MEMORY
        with tempfile.TemporaryDirectory(prefix="viewproj-mutant-") as folder, tempfile.TemporaryFile() as output:
            process = subprocess.Popen(
                ["sh", "-c", f'ulimit -d {limit} && exec "$@"', "sh", *command], cwd=properties.get("WORKING_DIRECTORY"),
                env={**env, "TMPDIR": folder}, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                status = process.wait(patience)
            except subprocess.TimeoutExpired:
                status = None
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
            output.seek(0)
            text = output.read().decode(errors="replace")
        if status is None:
            return "hangs", text
        if status != 0 and status == properties.get("SKIP_RETURN_CODE"):
            return "skipped", text
        if "PASS_REGULAR_EXPRESSION" in properties:
            printed = properties["PASS_REGULAR_EXPRESSION"][0].removeprefix("^")
            return ("passed" if text.startswith(printed) else "failed"), text
        if part and name not in GOLDEN and "No test" in text:
            return "selects nothing", text
        return ("passed" if status == 0 else "failed"), text


def configure(build, source):
    options = [
        "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",  # built once, run for minutes
        "-DVIEWPROJ_TESTS=ON", f"-DCMAKE_CXX_FLAGS=-w -include {source}/mutant.hpp",
    ]
    if subprocess.run(["sh", "-c", "command -v ccache"], stdout=subprocess.DEVNULL, check=False).returncode == 0:
        options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    if subprocess.run(["sh", "-c", "command -v ninja"], stdout=subprocess.DEVNULL, check=False).returncode == 0:
        options.append("-GNinja")
    subprocess.run(["cmake", "-S", source, "-B", build, *options], stdout=subprocess.DEVNULL, check=True)


def judge(suite, row, named_only):
    """(what killed it or None, whether the row names that)"""
    tried = set()
    for name, part in row.tests:
        for one in part.split() if name in GOLDEN and part else [part]:
            tried.add((name, one))
            result = suite.run(name, one, row.number)
            if result not in ("passed", "skipped"):
                return f"{name} {one}".strip() + (" (hangs)" if result == "hangs" else ""), True
    for name, part in () if named_only else suite.rest(tried):
        result = suite.run(name, part, row.number)
        if result not in ("passed", "skipped"):
            return f"{name} {part}".strip() + (" (hangs)" if result == "hangs" else ""), False
    return None, False


def table(rows, results):
    """Module by module, kind by kind: how many were made, killed by a test the row names, by another, by none."""
    lines = []
    for title, of in (("module", lambda row: row.module), ("kind", lambda row: row.kind)):
        lines.append(f"{title:14} made  killed as named  by another test  equivalent  SURVIVED")
        made = Counter(of(row) for row in rows)
        for key in [*sorted(made), "all"]:
            chosen = [row for row in rows if key in ("all", of(row))]
            named = sum(1 for row in chosen if results[row.name] == (results[row.name][0], True))
            other = sum(1 for row in chosen if results[row.name][0] and not results[row.name][1])
            equivalent = sum(1 for row in chosen if not results[row.name][0] and row.equivalent)
            lines.append(
                f"{key:14} {len(chosen):4} {named:16} {other:16} {equivalent:11} {len(chosen) - named - other - equivalent:9}"
            )
        lines.append("")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tables", nargs="+", type=Path)
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME", help="these mutations alone")
    parser.add_argument("--build", type=Path, default=ROOT / "build-mutants")
    parser.add_argument("--named", action="store_true", help="no tests but those the rows name")
    parser.add_argument("--list", action="store_true", help="check the rows against the sources, and list them")
    arguments = parser.parse_args()

    build = arguments.build.resolve()
    source = build / "source"
    rows = mutants.read_tables(arguments.tables)
    mutants.write_sources(ROOT, source, rows)
    if arguments.list:
        for row in rows:
            print(f"{row.number:10} {row.name:40} {row.kind:14} {row.file}")
        return 0
    unknown = set(arguments.only) - {row.name for row in rows}
    if unknown:
        raise mutants.BrokenRow(f"there is no {' '.join(sorted(unknown))}")

    configure(build, source)
    suite = Suite(build)
    broken = [what for row in rows for what in suite.wrong(row)]
    if broken:
        raise mutants.BrokenRow("\n  ".join(broken))
    begun = time.monotonic()
    subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count())], check=True)
    suite = Suite(build)  # ctest says how a program is run once it is there
    print(f"{len(rows)} mutations, built in {time.monotonic() - begun:.0f} s")

    chosen = [row for row in rows if row.name in arguments.only] if arguments.only else list(rows)
    results = {}

    def one(row):
        begun = time.monotonic()
        killer, named = judge(suite, row, arguments.named)
        results[row.name] = (killer, named)
        said = f"killed by {killer}{'' if named else ', which it does not name'}" if killer else "SURVIVED"
        if not killer and row.equivalent:
            said = f"equivalent: {row.equivalent}"
        print(f"{row.name}: {said} ({time.monotonic() - begun:.1f} s)", flush=True)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(one, chosen))

    ran = [row for row in chosen if row.name in results]
    print(f"\n{len(ran)} of {len(rows)} mutations")
    print(table(ran, results))
    killed = [row for row in ran if results[row.name][0]]
    survived = [row for row in ran if not results[row.name][0] and not row.equivalent]
    for row in survived:
        print(f"SURVIVED {row.name} ({row.where}): {row.seen}")
    mistaken = [row for row in killed if row.equivalent]
    for row in mistaken:
        print(f"NOT EQUIVALENT {row.name} ({row.where}): killed by {results[row.name][0]}")
    equivalent = sum(1 for row in rows if row.equivalent)
    if equivalent * 20 > len(rows):
        print(f"{equivalent} of {len(rows)} are said to be equivalent: more than 5 %")
    return 1 if survived or mistaken or equivalent * 20 > len(rows) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except mutants.BrokenRow as broken:
        sys.exit(f"mutation: {broken}")
