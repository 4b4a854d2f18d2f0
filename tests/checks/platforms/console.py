"""The tool at a console of Windows, as wine makes one of a terminal.

    python3 console.py CAMERA ANSWER COMMAND...     COMMAND runs the tool; ANSWER: to the point 1 1 1
"""
import os
import pty
import re
import select
import sys
import time
import tty

PATIENCE = 60  # seconds


def shown(command, keys=()):
    """What the console shows, escapes apart, and the status. keys: pairs of what is waited for and what is typed then."""
    process, terminal = pty.fork()
    if process == 0:
        os.environ["TERM"] = "xterm"
        os.execvp(command[0], command)
    tty.setraw(terminal)
    text, keys, end = b"", list(keys), time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            try:
                text += os.read(terminal, 4096)
            except OSError:  # the tool has ended
                break
        if keys and keys[0][0].encode() in text:
            os.write(terminal, keys.pop(0)[1].encode())
    else:
        os.kill(process, 9)
        sys.exit(f"console: does not end; shows {text!r}")
    status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    return re.sub(r"\x1b\[[0-9?]*[a-zA-Z]", "", text.decode()).replace("\r", ""), status


def check(what, found, expected):
    if found != expected:
        sys.exit(f"console: {what}: {found!r} in place of {expected!r}")


camera, answer, *tool = sys.argv[1:]
seen, status = shown([*tool, "project", "-c", camera], [("Ctrl-Z", "1 1 1\r"), (answer[:20], "\x1a\r")])
lines = [line for line in seen.splitlines() if line]
check("a line is answered when it is typed", lines[-3:], ["1 1 1", answer, "^Z"])
check("the keyboard is told of", "".join(lines[:-3]),
      "viewproj: reading from the keyboard; Ctrl-Z and Enter end the input, Ctrl-C the run")
check("the status after Ctrl-Z", status, 0)
seen, status = shown([*tool, "project", "-c", "fehlt 欠 ä.json", "--point", "1,1,1"])
check("text beyond ASCII", (seen, status), ("viewproj: fehlt 欠 ä.json: No such file or directory\n", 1))
print("a console is written to in UTF-8, answered line by line, and ends by Ctrl-Z")
