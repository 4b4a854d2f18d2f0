"""Golden tests of the command line: transcripts/*.txt, what a user sees at a prompt.

  python3 -B transcripts.py VIEWPROJ [NAME of a case | FILE of cases]...     default: all
  python3 -B transcripts.py VIEWPROJ --list                                  the names of the cases
  python3 -B transcripts.py VIEWPROJ --folders FOLDER                        each case as a folder of its files and cmd

VIEWPROJ is the executable. A transcript holds

  # words             about what follows
  == title            a case; its name is the title with a hyphen for each blank
  -- FILE             a file of the case, and its lines indented by two
  $ command           shell lines; the word viewproj is the executable
  > the command's next line
    what it prints    indented by two
  ! what it prints on standard error
  [2]                 its exit status, where that is not 0, or not 1 after a message that is no note

and blank lines between these. A line that ends in " (esc)" has backslashes for what cannot be seen (\\t \\r \\xNN \\\\), and
" (no-eol)" ends what has no newline at its end. An empty line is blank, but the last one of an output or file is "(esc)".

The commands of a case run in one shell, bash, in a folder of its own with its files; files beside the transcripts are at
"..". A pipe has the status of what failed in it, but for a reader
that has seen enough. Each command's output, errors and status are compared, byte for byte. A
case that takes more than a minute (VIEWPROJ_PATIENCE, in seconds) or 2 GiB fails. Prints the cases that fail, as
differences, and a closing line. In the environment, JOBS=N: so many cases at a time, else one for each processor; STOP=1:
none after one that fails;
REGENERATE=1 writes what the commands give into the transcripts instead, for git diff to show.
"""
import argparse
import concurrent.futures
import difflib
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# Whose pipes have the status of the tool, whatever comes after it.
SHELL = ["bash", "--posix", "-o", "pipefail", "-O", "xpg_echo"]
FOLDER = Path(__file__).resolve().parent / "transcripts"
MARKED = re.compile(r"(?:^|.* )\((?:esc|no-eol)\)")
ESCAPES = {"\t": "\\t", "\r": "\\r", "\\": "\\\\"}
UNESCAPED = {shown.encode(): character.encode() for character, shown in ESCAPES.items()}


class Malformed(Exception):
    """Of a transcript, or of what is asked for."""


def shown(text, unended=False):
    """A line of bytes as it stands in a transcript; unended: without a newline."""
    line = text.decode("utf-8", "surrogateescape")
    if not line.isprintable() or line.endswith(" ") or MARKED.fullmatch(line):
        line = re.sub(" $", r"\\x20", "".join(map(escaped, line))) + " (esc)"
    return line + " (no-eol)" if unended else line


def escaped(character):
    if character in ESCAPES or character.isprintable():
        return ESCAPES.get(character, character)
    return "".join(f"\\x{byte:02x}" for byte in character.encode("utf-8", "surrogateescape"))


def read(line):
    """The bytes that shown() shows, with their newline."""
    line, unended = re.subn(r" \(no-eol\)$", "", line)
    line, has_escapes = re.subn(r"(^| )\(esc\)$", "", line)
    text = line.encode()
    if has_escapes:
        if not re.fullmatch(rb"(?:[^\\]|\\[tr\\]|\\x[0-9a-f]{2})*", text):
            raise Malformed(f"no such escape: {line}")
        text = re.sub(rb"\\(?:x(..)|.)", lambda m: bytes.fromhex(m[1].decode()) if m[1] else UNESCAPED[m[0]], text)
    return text if unended else text + b"\n"


def block(text, mark):
    """An output, or a file, as lines of a transcript."""
    if not text:
        return []
    *lines, rest = text.split(b"\n")
    lines = [shown(line) for line in lines] + ([shown(rest, unended=True)] if rest else [])
    if mark == "  ":
        return [mark + line if line else "" for line in lines[:-1]] + [mark + (lines[-1] or "(esc)")]
    return [(mark + line).rstrip(" ") for line in lines]


class Case:
    def __init__(self, path, number, title):
        self.where, self.path, self.name = f"{path.name}:{number}", path, title.replace(" ", "-")
        self.lines = []     # as they stand in the transcript, from the title on
        self.files = {}     # by name: their lines
        self.commands = []  # [the shell's lines, how many of self.lines end there, the lines of what is printed]

    def write(self, folder):
        folder.mkdir()
        for name, lines in self.files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(b"".join(lines))

    def with_outputs(self, outputs):
        """The lines of the case, were this what its commands print."""
        lines, begin = [], 0
        for (_, end, expected), output in zip(self.commands, outputs):
            lines += self.lines[begin:end] + output
            begin = end + len(expected)
        return lines + self.lines[begin:]


def parse_line(line, blanks, before, case, block_lines):
    """What follows belongs to the list that is returned; blanks: how many blank lines are before this one."""
    mark = line[:2]
    if mark == "$ ":
        case.commands.append([read(line[2:]), len(case.lines) + 1, []])
        return case.commands[-1][2]
    if mark in ("> ", ">") and before in ("$ ", "> ", ">"):
        case.commands[-1][0] += read(line[2:])
        case.commands[-1][1] += 1
        return block_lines
    if line.startswith("-- ") and not case.commands and line[3:] not in case.files:
        if not line[3:].strip() or line[3] == "/" or ".." in line[3:].split("/"):
            raise Malformed(f"no name of a file: {line}")
        case.files[line[3:]] = []
        return case.files[line[3:]]
    if block_lines is not None and case.commands and (mark in ("  ", "! ", "!") or re.fullmatch(r"\[\d+\]", line)):
        block_lines += [""] * blanks + [line]
    elif block_lines is not None and mark == "  ":
        block_lines += [b"\n"] * blanks + [read(line[2:])]
    elif line:
        raise Malformed(f"malformed: {line}")
    return block_lines


def parse(path):
    """The lines before the first case, and the cases."""
    head, cases, block_lines, before, blanks = [], [], None, "", 0
    number = 0
    try:
        lines = path.read_bytes().decode().split("\n")
        if not lines[0].startswith("# "):
            raise Malformed("begins with no line of # words")
        if lines.pop() != "":
            raise Malformed("ends without a newline")
        for number, line in enumerate(lines, 1):
            if line.startswith("== ") and re.fullmatch(r"[^\s/-]+( [^\s/-]+)*", line[3:]):
                cases.append(Case(path, number, line[3:]))
                block_lines = None
            elif line.startswith("# "):
                block_lines = None
            elif cases:
                block_lines = parse_line(line, blanks, before, cases[-1], block_lines)
            elif line:
                raise Malformed(f"stands in no case: {line}")
            (cases[-1].lines if cases else head).append(line)
            before, blanks = line[:2], 0 if line else blanks + 1
        number = len(lines)
        if not cases:
            raise Malformed("has no case")
    except (Malformed, IndexError, UnicodeDecodeError) as error:
        raise Malformed(f"{path.name}:{number}: {error}") from error
    return head, cases


def run(case, top):
    """What each command prints, as lines of a transcript; and what kept the case from its end."""
    case.write(top / "cases" / case.name)
    given = top / case.name
    given.mkdir()
    script = b""
    for n, (command, _, _) in enumerate(case.commands):
        at = shlex.quote(f"{given}/{n}")
        script += f"exec >{at}.out 2>{at}.err\n".encode() + command + f"echo $? >{at}.status\n".encode()
    status = subprocess.run(
        ["timeout", "-k", "5", os.environ.get("VIEWPROJ_PATIENCE", "60"), *SHELL, "-c", script],
        cwd=top / "cases" / case.name,
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False,
    ).returncode
    outputs, wrong = [], "takes too long" if status in (124, 137) else ""
    for n in range(len(case.commands)):
        out, err, its = (given / f"{n}{end}" for end in (".out", ".err", ".status"))
        if not out.exists():
            outputs.append(["(is not run)"])
            wrong = wrong or "ends before its last command"
            continue
        code = int(its.read_text()) if its.exists() else status
        code = 0 if code == 141 else code  # of a command that fed a tool which had seen enough
        errors = block(err.read_bytes(), "! ")
        usual = any(re.match("! viewproj: (?!note: )", line) for line in errors)
        outputs.append(block(out.read_bytes(), "  ") + errors + ([f"[{code}]"] if code != usual else []))
    shutil.rmtree(given)
    return outputs, wrong


def check(arguments, transcripts, cases):
    """How many cases fail."""
    tool = Path(arguments.viewproj)
    if tool.name != "viewproj" or not os.access(tool, os.X_OK) or not tool.is_file():
        raise Malformed(f"{tool} is no executable that is called viewproj")
    if not re.search(rb"__(asan|tsan)_init", tool.read_bytes()):  # as limits.sh has it
        resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
    os.environ.update(PATH=f"{tool.absolute().parent}:{os.environ['PATH']}", LC_ALL="C")
    os.environ.pop("COLUMNS", None)
    regenerate = os.environ.get("REGENERATE") == "1"
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        top = Path(folder)
        share(top / "cases")
        with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
            results = {}
            for case, result in zip(cases, pool.map(lambda case: run(case, top), cases)):
                results[case.name] = result
                if os.environ.get("STOP") and (result[1] or case.with_outputs(result[0]) != case.lines):
                    pool.shutdown(cancel_futures=True)
                    break
    for path, (head, its) in transcripts.items():
        for case in its:
            if case.name not in results:
                continue
            outputs, wrong = results[case.name]
            lines = case.with_outputs(outputs)
            if wrong or lines != case.lines and not regenerate:
                failed += 1
                print(f"--- {case.name} ({case.where}){wrong and ': ' + wrong}")
                print("\n".join(list(difflib.unified_diff(case.lines, lines, lineterm=""))[2:]))
            else:
                case.lines = lines
        if regenerate:
            path.write_bytes("\n".join([*head, *(line for case in its for line in case.lines), ""]).encode())
    print(f"{len(cases) - failed} {'written' if regenerate else 'passed'}, {failed} failed")
    return failed


def share(folder):
    """Files beside the cases."""
    folder.mkdir(parents=True)
    for path in FOLDER.iterdir():
        if path.suffix != ".txt":
            shutil.copy(path, folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("viewproj")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--folders", type=Path)
    arguments = parser.parse_intermixed_args()
    transcripts = {path: parse(path) for path in sorted(FOLDER.glob("*.txt"))}
    every = {}
    for case in (case for _, cases in transcripts.values() for case in cases):
        if not case.commands or case.name in every:
            what = "is there twice" if case.name in every else "has no command"
            raise Malformed(f"{case.where}: {case.name} {what}")
        every[case.name] = case
    chosen = {} if arguments.names else every
    for name in arguments.names:
        its = [case for case in every.values() if case.name == name.replace(" ", "-") or case.path == Path(name).resolve()]
        if not its:
            near = "".join(f"; did you mean {other}?" for other in difflib.get_close_matches(name, every, 1))
            raise Malformed(f"there is no case {name}, nor such a file in {FOLDER}{near}")
        chosen.update((case.name, case) for case in its)
    if not chosen:
        raise Malformed(f"no cases in {FOLDER}")
    if arguments.list:
        print("\n".join(sorted(chosen)))
    elif arguments.folders:
        share(arguments.folders)
        for case in chosen.values():
            case.write(arguments.folders / case.name)
            (arguments.folders / case.name / "cmd").write_bytes(b"".join(command[0] for command in case.commands))
    else:
        return 1 if check(arguments, transcripts, list(chosen.values())) else 0
    return 0


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8", errors="surrogateescape")
    try:
        sys.exit(main())
    except Malformed as malformed:
        sys.exit(f"transcripts.py: {malformed}")
