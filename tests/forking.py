"""Processes for tests that need one of their own: forked from one interpreter that has imported the slow libraries once."""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

# Reads one request per line: in each child the streams are files, and code that ends with an exception prints it.
_SERVER = """
import importlib, json, os, sys, traceback
for name in sys.argv[1:]:
    importlib.import_module(name)
def run(asked):
    for stream in (1, 2):
        os.dup2(os.open(asked["streams"][stream - 1], os.O_WRONLY | os.O_CREAT, 0o600), stream)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.chdir(asked["folder"])
    os.environ.update(asked["environment"])
    sys.path.insert(0, asked["folder"])
    sys.argv = ["-c", *asked["words"]]
    try:
        exec(compile(asked["code"], "<code>", "exec"), {"__name__": "__main__"})
    except SystemExit as ended:
        return ended.code or 0
    except BaseException:
        traceback.print_exc()
        return 1
    return 0
for line in sys.stdin:
    child = os.fork()
    if not child:
        code = run(json.loads(line))
        sys.stdout.flush(), sys.stderr.flush()
        os._exit(code)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""


@dataclass
class Ended:
    """How a process ended: its exit code, and what it wrote."""

    returncode: int
    stdout: str
    stderr: str


class Interpreter:
    """Run code in processes that share the imports of one interpreter, and nothing else."""

    def __init__(self, *modules, before="", **environment):
        words = [sys.executable, "-c", before + _SERVER, *modules]
        streams = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        self._process = subprocess.Popen(words, env=os.environ | environment, text=True, **streams)

    def run(self, code, *words, folder, **environment):
        """Run the code in a folder, with words as sys.argv[1:] and these variables of the environment."""
        with tempfile.TemporaryDirectory() as place:
            streams = [Path(place) / name for name in ("stdout", "stderr")]
            asked = {"code": code, "words": [*map(str, words)], "folder": str(folder), "environment": environment}
            self._process.stdin.write(json.dumps(asked | {"streams": [*map(str, streams)]}) + "\n")
            self._process.stdin.flush()
            code = int(self._process.stdout.readline())
            return Ended(code, *(one.read_text(encoding="utf-8") for one in streams))

    def close(self):
        self._process.stdin.close()
        self._process.wait(60)
        self._process.stdout.close()
