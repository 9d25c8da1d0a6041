"""Mutants of cmodel/ and driver/: the folder's fast tests over mutated sources, a process for each mutant, until the first test fails."""
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time

# Processor seconds of a mutant, beside so many times what the healthy tests take.
_SECONDS, _TIMES = 5, 3


def _ran(binary: str, number: int, limit: int):
    """(exit code or minus the signal, output, processor seconds)"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)

    def limits():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    ran = subprocess.run(["nice", "-n", "5", binary, "--gtest_fail_fast", "--gtest_brief=1"], env={**os.environ, "FASTSPLAT_MUTANT": str(number)},
                         stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", preexec_fn=limits)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return ran.returncode, ran.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _verdict(code: int, output: str):
    if code == 0:
        passed = re.search(r"\[  PASSED  \] (\d+) tests?", output)
        return ("lives", f"{passed.group(1)} tests") if passed and int(passed.group(1)) > 0 else ("killed", "nothing ran: no test")
    failed = re.search(r"^\[  FAILED  \] ([\w/.]+)", output, re.M)
    if failed:
        return "killed", f"{failed.group(1).split('.')[0].split('/')[-1]}: {failed.group(1)}"
    name = {-signal.SIGXCPU: "processor time", -signal.SIGKILL: "processor time"}.get(code, "the program dies")
    return "killed", f"{name}: exit {code}"


def run(binary: str, numbers: list[int], jobs: int, until=None) -> dict[int, tuple[str, str]]:
    code, output, seconds = _ran(binary, 0, 600)
    if _verdict(code, output)[0] != "lives":
        print(f"mutate: error: {os.path.basename(binary)}: the tests fail without a mutant:\n{output[-2000:]}", file=sys.stderr)
        sys.exit(1)
    limit = int(_SECONDS + _TIMES * seconds)
    results, left, lock = {}, list(numbers), threading.Lock()

    def work():
        while True:
            with lock:
                if not left or (until is not None and time.monotonic() > until):
                    return
                number = left.pop(0)
            code, output, _ = _ran(binary, number, limit)
            with lock:
                results[number] = _verdict(code, output)
                if sys.stderr.isatty():
                    print(f"\rmutate: {len(results)} of {len(numbers)} ", end="", file=sys.stderr, flush=True)

    threads = [threading.Thread(target=work) for _ in range(max(1, jobs))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return dict(sorted(results.items()))
