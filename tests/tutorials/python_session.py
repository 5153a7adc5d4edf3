"""Executes blocks of Python in one namespace: reads a JSON object per line, and prints its `end` after each block.

Object: {"file": name in tracebacks, "line": of the first line, "text": the block, "end": the line to print}.
After an exception it prints the traceback and ends with exit code 1.
"""
import json
import sys
import traceback


def main():
    namespace = {"__name__": "__main__"}
    for request in sys.stdin:
        block = json.loads(request)
        try:
            code = compile("\n" * (block["line"] - 1) + block["text"], block["file"], "exec")
            exec(code, namespace)  # the tutorials are part of the project
        except BaseException:  # also SystemExit, which would pass for success
            sys.stdout.flush()
            traceback.print_exc(file=sys.stdout)
            sys.stdout.flush()
            return 1
        print(block["end"], flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
