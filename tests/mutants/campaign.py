# SPDX-License-Identifier: Apache-2.0
"""Mutants through a check_mutants program, several at a time."""
import hashlib
import os
import re
import subprocess
import sys
import threading
import time


def usage(text: str):
    print(f"mutate: error: {text}", file=sys.stderr)
    sys.exit(2)


def write(path: str, text: str):
    """Whole or not at all; nothing where it is the same already."""
    if os.path.exists(path):
        with open(path) as file:
            if file.read() == text:
                return
    with open(path + ".new", "w") as file:
        file.write(text)
    os.replace(path + ".new", path)


def name_of(mutant) -> str:
    """As exclusions.toml has it: alone on its line, nearly always."""
    return mutant["what"] if mutant["what"] == "dropped" else f"{mutant['what']} of {mutant['original']}"


def built(folder: str) -> set[int]:
    """The numbers that a Verilated program in this folder asks for, and constants that are none. A mutant that is not among them stands where the
    device's parameters decide against it: there is no code of it, and nothing to try."""
    sources = [name for name in os.listdir(folder) if name.endswith((".cpp", ".h"))]
    numbers = set()
    for name in sources:
        with open(f"{folder}/{name}") as file:
            numbers.update(int(constant, 0) for constant in re.findall(r"\b(?:0x[0-9a-f]+|[1-9][0-9]*)(?=U|L|\b)", file.read()))
    if not numbers:
        raise RuntimeError(f"{folder}: no Verilated source")
    return numbers


class Server:
    """One process of the program; it says first that the device without a mutant lives."""

    def __init__(self, binary: str, config: str):
        self.process = subprocess.Popen(["nice", "-n", "5", binary, config], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        healthy = self.process.stdout.readline().strip()
        if not healthy.startswith("0 lives "):
            raise RuntimeError(f"{os.path.basename(binary)}: the device without a mutant fails: {healthy or 'nothing said'}")
        self.comparisons = int(healthy.split()[2])

    def judge(self, number: int) -> tuple[str, str]:
        self.process.stdin.write(f"{number}\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline().rstrip("\n").split(" ", 2)
        if len(line) < 3 or line[0] != str(number) or line[1] not in ("killed", "lives"):
            raise RuntimeError(f"mutant {number}: no verdict but {line}")
        return line[1], line[2]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Journal:
    """What was said of mutants by what is made of these very files (a program and its configuration, proofs): a campaign that was stopped goes
    on where it was."""

    def __init__(self, name: str, paths: list[str], folder: str):
        of = hashlib.sha256()
        for path in paths:
            with open(path, "rb") as file:
                of.update(file.read())
        os.makedirs(folder, exist_ok=True)
        self.path = f"{folder}/{name}-{of.hexdigest()[:16]}.txt"
        self.file = open(self.path, "a+")
        self.file.seek(0)
        # A line that was cut off where the campaign was killed counts for nothing.
        whole = self.file.read().rpartition("\n")[0]
        self.file.truncate(len(whole.encode()) + 1 if whole else 0)
        self.said = {}
        for line in whole.split("\n") if whole else []:
            number, verdict, said = line.split(" ", 2)
            self.said[int(number)] = (verdict, said)

    def add(self, number: int, verdict: tuple[str, str]):
        self.file.write(f"{number} {verdict[0]} {verdict[1]}\n")
        self.file.flush()


def run(binary: str, config: str, numbers: list[int], jobs: int, until=None, journal=None) -> dict[int, tuple[str, str]]:
    """{number: (killed or lives, what was said)}, without those not begun when the time was over."""
    results = {number: journal.said[number] for number in numbers if number in journal.said} if journal else {}
    errors, left, lock = [], [number for number in numbers if number not in results], threading.Lock()
    if results:
        print(f"mutate: {len(results)} of {len(numbers)} were run before: {journal.path}", file=sys.stderr, flush=True)
    began, shown = time.monotonic(), [0.0]

    def work():
        try:
            server = Server(binary, config)
            while not errors:
                with lock:
                    if not left or (until is not None and time.monotonic() > until):
                        break
                    number = left.pop(0)
                verdict = server.judge(number)
                with lock:
                    results[number] = verdict
                    if journal:
                        journal.add(number, verdict)
                    if sys.stderr.isatty() and time.monotonic() - shown[0] > 0.2:
                        shown[0] = time.monotonic()
                        print(f"\rmutate: {len(results)} of {len(numbers)}, {time.monotonic() - began:.0f} s ", end="", file=sys.stderr, flush=True)
            server.close()
        except Exception as error:  # reported by the requesting thread
            errors.append(error)

    threads = [threading.Thread(target=work) for _ in range(min(max(1, jobs), len(left)))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    if errors:
        print(f"mutate: error: {errors[0]}", file=sys.stderr)
        sys.exit(1)
    return dict(sorted(results.items()))
