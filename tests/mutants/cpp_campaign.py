# SPDX-License-Identifier: Apache-2.0
"""Mutants below tests: cmodel/ and driver/, fetch and top. The folder's tests run over mutated sources, a process for each mutant, until the first
test fails."""
import json
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
# A test that takes no more of the whole time than this runs first.
_CHEAP = 0.005


def _ran(binary: str, number: int, limit: int, *flags: str):
    """(exit code or minus the signal, output)"""

    def limits():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    ran = subprocess.run(["nice", "-n", "5", binary, "--gtest_fail_fast", "--gtest_brief=1", *flags], env={**os.environ, "FASTSPLAT_MUTANT": str(number)},
                         stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", preexec_fn=limits)
    return ran.returncode, ran.stdout


def _healthy(binary: str) -> list[tuple[str, float]]:
    """[(flag, processor seconds)]: the cheap tests, then the others; they pass without a mutant, or there is nothing to try."""
    report = binary + ".json"

    def passes(flag: str) -> float:
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        code, output = _ran(binary, 0, 600, flag)
        if _verdict(code, output)[0] != "lives":
            print(f"mutate: error: {os.path.basename(binary)}: the tests fail without a mutant:\n{output[-2000:]}", file=sys.stderr)
            sys.exit(1)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - used.ru_utime - used.ru_stime

    all_seconds = passes(f"--gtest_output=json:{report}")
    with open(report) as file:
        tests = [(float(test["time"].rstrip("s")), f"{suite['name']}.{test['name']}") for suite in json.load(file)["testsuites"]
                 for test in suite["testsuite"]]
    all_time = sum(seconds for seconds, _ in tests)
    parts = [[name for seconds, name in tests if (seconds <= _CHEAP * all_time) == cheap] for cheap in (True, False)]
    said = [("--gtest_filter=" + ":".join(part), 0.0) for part in parts if part]
    cheap_seconds = passes(said[0][0])
    return [(said[0][0], cheap_seconds)] + [(flag, all_seconds) for flag, _ in said[1:]]


def _verdict(code: int, output: str):
    if code == 0:
        passed = re.search(r"\[  PASSED  \] (\d+) tests?", output)
        return ("lives", f"{passed.group(1)} tests") if passed and int(passed.group(1)) > 0 else ("killed", "nothing ran: no test")
    failed = re.search(r"^\[  FAILED  \] ([\w/.]+)", output, re.M)
    if failed:
        return "killed", f"{failed.group(1).split('.')[0].split('/')[-1]}: {failed.group(1)}"
    name = {-signal.SIGXCPU: "processor time", -signal.SIGKILL: "processor time"}.get(code, "the program dies")
    return "killed", f"{name}: exit {code}"


def run(binary: str, numbers: list[int], jobs: int, until=None, journal=None) -> dict[int, tuple[str, str]]:
    """As campaign.run."""
    results = {number: journal.said[number] for number in numbers if number in journal.said} if journal else {}
    left, lock = [number for number in numbers if number not in results], threading.Lock()
    passes = _healthy(binary) if left else []

    def judged(number: int):
        said = []
        for flag, seconds in passes:
            verdict = _verdict(*_ran(binary, number, int(_SECONDS + _TIMES * seconds), flag))
            if verdict[0] == "killed":
                return verdict
            said.append(verdict[1])
        return "lives", ", then ".join(said)

    def work():
        while True:
            with lock:
                if not left or (until is not None and time.monotonic() > until):
                    return
                number = left.pop(0)
            verdict = judged(number)
            with lock:
                results[number] = verdict
                if journal:
                    journal.add(number, verdict)
                if sys.stderr.isatty():
                    print(f"\rmutate: {len(results)} of {len(numbers)} ", end="", file=sys.stderr, flush=True)

    threads = [threading.Thread(target=work) for _ in range(max(1, jobs))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return dict(sorted(results.items()))
