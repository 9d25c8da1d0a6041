"""generate_cpp.py SOURCE_DIR MODULE OUT_DIR COUNT SEED: the sources of MODULE (cmodel or driver) with COUNT of their mutants in
them, as many of each file as its share is; chosen at run time (selected.hpp). mutants.json says what each number is."""
import json
import os
import random
import sys

from cplusplus import CppMutator
from generate import write

FOLDERS = {"cmodel": ["cmodel", "cmodel/fast"], "driver": ["driver"]}
# Highway compiles it once for each processor, by its own name.
LEFT = {"cmodel/fast/row_kernel.cpp"}


def sources(root: str, module: str) -> list[str]:
    found = [f"{folder}/{name}" for folder in FOLDERS[module] for name in sorted(os.listdir(f"{root}/{folder}")) if name.endswith(".cpp")]
    return [path for path in found if path not in LEFT]


def mutate(root: str, module: str, wanted=lambda module, number: True):
    """[(path, text, mutants)] and the number after the last."""
    out, number = [], 1
    for path in sources(root, module):
        with open(f"{root}/{path}") as file:
            mutator = CppMutator(module, path, file.read(), number, wanted)
        text = mutator.result()
        number = mutator.number
        out.append((path, text, mutator.mutants))
    return out, number


def main(words) -> int:
    root, module, out, count, seed = words
    _, after = mutate(root, module, lambda m, n: False)
    chosen = set(random.Random(int(seed)).sample(range(1, after), min(int(count), after - 1)))
    mutated, _ = mutate(root, module, lambda m, n: n in chosen)
    listed = []
    for path, text, mutants in mutated:
        os.makedirs(os.path.dirname(f"{out}/{path}"), exist_ok=True)
        write(f"{out}/{path}", text)
        listed += mutants
    write(f"{out}/mutants.json", json.dumps([vars(m) for m in listed], indent=0))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
