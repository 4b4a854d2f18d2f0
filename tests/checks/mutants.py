"""Do the tests notice small bugs? Mutants are made from the sources, all in one build, and the tests run under each.

    python3 -B tests/checks/mutants.py [--count 400] [--seed 1] [--under lib/projection] [--build build-mutants]

Operators: constants moved, comparisons and signs changed, statements deleted, arguments swapped (mutants.hpp). So many are
drawn by the seed, the same ones as long as their lines are the same; each meets the tests nearest to its file, and only those
that survive meet all others. A number that is on stands in VIEWPROJ_MUTANT. Answers stand in BUILD/answers.jsonl: a run that
was stopped goes on where it was. Survivors are listed: each is equivalent, or a test is missing. Those that were read and change
no result (a wider margin, a shortcut not taken) stand in equivalent_mutants.txt, with the reason, and do not count. Status 1:
fewer than 92 % of the others were killed.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LEAST_KILLED = 0.92
# Tests of what no mutation changes, of the build, or of outside judges; all tests but these meet a survivor.
LEFT_OUT = ("kernels_share_no_code", "headers", "faults_Calls")
# Tests of the library, which run of cmd only the files that stand below with them.
OF_THE_LIBRARY = ("reference", "bounds", "shapes", "peers", "opengl")
# The tests that meet a mutant first, by the folder of its file: the first that is a prefix counts.
NEAREST = (
    ("lib/scene", "shapes unit reference"),
    ("lib/geodesy", "unit reference"),
    ("lib/matrices", "reference peers unit"),
    ("lib", "unit reference bounds peers shapes"),
    ("cmd/stream", "stream cmd"),
    ("cmd/records/model", "reference cmd"),
    ("cmd/commands/depth", "reference cmd"),
    ("cmd/text", "unit stream cmd"),
    ("cmd/records", "stream cmd"),
    ("cmd/formats", "camera importers_decimals importers_three importers_opencv cmd"),
    ("cmd/camera", "camera importers_decimals importers_three importers_opencv cmd"),
    ("cmd/picture", "draw cmd"),
    ("cmd/commands", "cmd check draw explain"),
    ("cmd", "output cmd"),
)
OPERATORS = {"+": "Plus", "-": "Minus", "*": "Times", "/": "Over", "<": "Less", ">": "Greater", "<=": "LessOrSame",
             ">=": "GreaterOrSame", "==": "Same", "!=": "Other"}
READING = """#include <cstdlib>
int viewprojMutant = 0;
__attribute__((constructor(101))) static void readMutant() {
  if (const char* number = std::getenv("VIEWPROJ_MUTANT")) viewprojMutant = std::atoi(number);
}
"""
# Of these lines nothing is run, or only by the compiler.
NO_CODE = re.compile(r"^\s*(//|#|\*|template|static_assert|using |enum |struct |class |namespace |case |default:|friend |explicit )")
COMPILE_TIME = re.compile(r"^\s*(?!.*\) (const )?(noexcept )?\{$)(inline |static )*constexpr .*\{$|^\s*consteval .*\{$")
# A member's first value: all members are set before they are read, but those of public structures.
MEMBER = re.compile(r"^  [\w:<>, ]+ \w+ = [^()]*;")
CONSTANT = re.compile(r"(?<![\w.<>'])(0x[\dA-Fa-f.]+p[-+]?\d+|\d+\.\d+(?:e[-+]?\d+)?|\d+)(?![\w.'>])")
OPERATOR = re.compile(r"(?<= )(\+|-|\*|/|<=|>=|==|!=|<|>)(?= )")
STATEMENT = re.compile(r"^(\s+)((?!return|if|for|while|else|const|auto|throw|break|continue|delete|goto|do\b|\}|case)[\w.\[\]()>:-]+"
                       r"(?:\([^{]*\)| [-+*/|&^]?= [^{]*);)$")
ARRAY = re.compile(r"^\s*(?:alignas\(\w+\) )?(?:[\w:<>]+ )+\w+\[(.*?)\]")  # one that is larger does the same
SYMMETRIC = re.compile(r"(^|::)(dot|min|max|minmax|hypot)$")  # swapped arguments change nothing
# A mutant that reads or writes beyond an array is found, as the sanitizers would find it.
FLAGS = "-w -Wno-narrowing -fpermissive -D_GLIBCXX_ASSERTIONS -fsanitize=bounds -fsanitize-undefined-trap-on-error"
CALL = re.compile(r"(?<![\w.:>] )(?<![\w.:>~])((?:[\w]+::)*[a-z]\w*)\(([\w.]+), ([\w.]+)\)(?! *\{)")


def blanked(line):
    """With strings, characters and comments replaced by as many underscores."""
    return re.sub(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)\'|//.*', lambda m: "_" * len(m[0]), line)


def candidates(file, text):
    """(file, line, start, end, kind, what takes its place, with ID for the number)."""
    statement = ""
    raw = False
    depth = 0  # of braces that only the compiler runs
    in_class = False
    for number, line in enumerate(text.split("\n")):
        seen = blanked(line)
        if depth or COMPILE_TIME.match(line):
            depth = max(0, depth + seen.count("{") - seen.count("}"))
            if "[](" not in seen:  # a function in a table is run
                continue
        in_class = bool(re.match(r"(struct|class) .*\{$", line)) or (in_class and not line.startswith("}"))
        if in_class and MEMBER.match(line) and "lib/viewproj/" not in file:
            continue
        raw = raw != (line.count('R"') + line.count(')"') % 2 == 1)
        begins = not statement.strip()
        statement += seen
        skip = raw or NO_CODE.match(statement) or "constexpr" in statement or "operator" in seen or not line.startswith("  ")
        if not skip:
            if array := ARRAY.match(seen):
                seen = seen[:array.start(1)] + "_" * len(array[1]) + seen[array.end(1):]
            for m in CONSTANT.finditer(seen):
                other = f"2 * {m[1]} + 1" if "." in m[1] or "p" in m[1] else f"{m[1]} + 1"
                yield file, number, m.start(), m.end(), "constant", f"(MUTATED(ID) ? {other} : {m[1]})"
            for m in OPERATOR.finditer(seen):
                kind = "sign" if m[1] in "+-*/" else "comparison"
                yield file, number, m.start(), m.end(), kind, f"{m[1]} ::mutants::{OPERATORS[m[1]]}<ID>{{}} {m[1]}"
            for m in CALL.finditer(seen):
                if m[2] != m[3] and not (m[2] + m[3]).isdigit() and not SYMMETRIC.search(m[1]) and m[1] not in ("if", "for", "while", "switch", "return"):
                    call = f"[&](auto&& l, auto&& r) -> decltype({m[1]}(l, r)) {{ return {m[1]}(l, r); }}"
                    yield file, number, m.start(), m.end(), "swapped", f"::mutants::swapped<ID>({call}, {m[2]}, {m[3]})"
            if begins and (m := STATEMENT.match(line)) and seen.count("(") == seen.count(")"):
                yield file, number, len(m[1]), len(line), "deleted", f"{{ if (!MUTATED(ID)) {m[2]} }}"
        if re.search(r"[;{}:]\s*_*$", seen) or not seen.strip("_ "):
            statement = ""


def drawn(under, count, seed):
    files = sorted(path for folder in ("lib", "cmd") for path in (ROOT / folder).rglob("*.?pp"))
    names = [str(path.relative_to(ROOT)) for path in files]
    found = []
    for path, name in zip(files, names):
        if name.startswith(under) and "windows" not in name:
            text = path.read_text()
            lines = text.split("\n")
            found += [(hashlib.sha256(f"{seed} {name} {c[2:5]} {lines[c[1]]}".encode()).digest(), c) for c in candidates(name, text)]
    found = [c for _, c in sorted(found)]
    chosen, taken = [], set()
    for mutant in found:  # of several that overlap, one
        place = {(mutant[0], mutant[1], column) for column in range(mutant[2], mutant[3])}
        if len(chosen) < count and not place & taken:
            taken |= place
            chosen.append(mutant)
    return len(found), dict(enumerate(chosen, 1))


def write_if_changed(path, content):
    if not path.is_file() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def write_sources(source, mutants):
    """A copy of the project with these mutants in it."""
    by_file, wanted = {}, {source / "mutant.cpp"}
    for number, mutant in mutants.items():
        by_file.setdefault(mutant[0], []).append((number, mutant))
    for part in ("CMakeLists.txt", "README.md", "lib", "cmd", "tests", "samples"):
        for path in [ROOT / part, *(ROOT / part).rglob("*")]:
            name = str(path.relative_to(ROOT))
            if not path.is_file() or "node_modules" in name:
                continue
            content = path.read_bytes()
            if name in by_file:
                lines = content.decode().split("\n")
                for number, (_, line, start, end, _, new) in sorted(by_file[name], key=lambda m: -m[1][2]):
                    lines[line] = lines[line][:start] + new.replace("ID", str(number)) + lines[line][end:]
                switch = f'#include "{source}/tests/checks/mutants.hpp"\n#line 1\n'
                content = (switch + "\n".join(lines)).encode()
            if name == "lib/CMakeLists.txt":
                content += f"\ntarget_sources(libviewproj PRIVATE {source}/mutant.cpp)\n".encode()
            write_if_changed(source / name, content)
            wanted.add(source / name)
    write_if_changed(source / "mutant.cpp", READING.encode())
    for path in source.rglob("*"):
        if path.is_file() and path not in wanted:
            path.unlink()


def build(folder, mutants):
    """Compiles; drops what does not compile, and is no mutant."""
    source, binary = folder / "source", folder / "build"
    while True:
        write_sources(source, mutants)
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "-S", source, "-B", binary, "-GNinja", "-DCMAKE_BUILD_TYPE=Release", "-DVIEWPROJ_TESTS=ON", "-DVIEWPROJ_CATCH_OPTIONS=--abort",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS={FLAGS}", *launcher],
                       stdout=subprocess.DEVNULL, check=True)
        done = subprocess.run(["ninja", "-C", binary, "-k", "0", "-j", str(os.cpu_count())], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return
        # A line counts where the error is, and where it was called from.
        places = set(re.findall(r"source/((?:lib|cmd)/[^:\s]+):(\d+)", re.sub(r"FAILED.*|.*-o .*", "", done.stdout)))
        bad = [n for n, m in mutants.items() if (m[0], str(m[1] + 1)) in places]
        if not bad:
            sys.exit(done.stdout[-4000:])
        for number in bad:
            del mutants[number]


def limits():
    resource.setrlimit(resource.RLIMIT_DATA, (4 << 30, 4 << 30))


def run_tests(binary, number, selection, patience):
    """The first test that fails under this mutant, or nothing."""
    command = ["ctest", "--test-dir", binary, "--stop-on-failure", "--timeout", str(patience), *selection]
    done = subprocess.run(command, env={**os.environ, "VIEWPROJ_MUTANT": str(number), "STOP": "1", "JOBS": "1"}, capture_output=True, text=True, check=False,
                          preexec_fn=limits)
    if done.returncode == 0:
        return ""
    failed = re.search(r"^\s*\d+ - (\S+) \((.*?)\)", done.stdout, re.M)
    return f"{failed[1]} ({failed[2].lower()})" if failed else "ctest"


def only(names):
    return ["-R", f"^({'|'.join(names)})$"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--under", default="", help="only files whose names begin so")
    parser.add_argument("--build", type=Path, default=ROOT / "build-mutants")
    options = parser.parse_args()
    folder = options.build.resolve()
    found, mutants = drawn(options.under, options.count, options.seed)
    begun = time.monotonic()
    build(folder, mutants)
    print(f"{len(mutants)} of {found} possible mutants, built in {time.monotonic() - begun:.0f} s", flush=True)
    binary = folder / "build"
    if failed := run_tests(binary, 0, ["-E", f"^({'|'.join(LEFT_OUT)})$"], 900):
        sys.exit(f"without a mutant {failed} fails")
    answers_file = folder / "answers.jsonl"
    known = {}
    if answers_file.exists():
        known = {answer["what"]: answer["killer"] for answer in map(json.loads, answers_file.read_text().splitlines())}
    texts = {file: (ROOT / file).read_text() for file in {mutant[0] for mutant in mutants.values()}}

    def what_of(number):
        file, line, start, _, kind, _ = mutants[number]
        return f"{file}:{line + 1}:{start + 1}: {kind}: {texts[file].split(chr(10))[line].strip()}  // {hash_of(texts[file])}"

    def judge(number):
        begun, file = time.monotonic(), mutants[number][0]
        nearest = next(tests for prefix, tests in NEAREST if file.startswith(prefix)).split()
        killer = run_tests(binary, number, only(nearest), 60)
        if not killer:
            out = [*LEFT_OUT, *nearest, *(OF_THE_LIBRARY if file.startswith("cmd") else ())]
            killer = run_tests(binary, number, ["-E", f"^({'|'.join(out)})$"], 200)
        return number, killer, time.monotonic() - begun

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        left = [number for number in mutants if what_of(number) not in known]
        for done in concurrent.futures.as_completed([pool.submit(judge, number) for number in left]):
            number, killer, seconds = done.result()
            what = what_of(number)
            known[what] = killer
            with open(answers_file, "a") as answers:
                answers.write(json.dumps({"what": what, "killer": killer}) + "\n")
            print(f"{number}: {what.split('  //')[0]}: {'killed by ' + killer if killer else 'SURVIVED'}, {seconds:.1f} s", flush=True)
    equivalent = {line.split(" # ")[0] for line in (ROOT / "tests/checks/equivalent_mutants.txt").read_text().splitlines()}
    survived = [what_of(number).split("  //")[0] for number in mutants if not known[what_of(number)]]
    missed = [what for what in survived if re.sub(r":\d+:", ":", what, count=1) not in equivalent]
    killed, counted = len(mutants) - len(survived), len(mutants) - len(survived) + len(missed)
    print(f"{killed} of {counted} killed, {100 * killed / max(1, counted):.1f} %; {len(survived) - len(missed)} equivalent", *missed, sep="\n")
    return 0 if killed >= LEAST_KILLED * counted else 1


def hash_of(text):
    """Of a file: an answer counts as long as the file is the same."""
    value = 0
    for byte in text.encode():
        value = (value * 31 + byte) % (1 << 61)
    return f"{value:x}"


if __name__ == "__main__":
    sys.exit(main())
