# SPDX-License-Identifier: Apache-2.0
"""generate_cpp.py SOURCE_DIR MODULE OUT_DIR COUNT SEED: the sources and headers of MODULE (cmodel or driver) with COUNT of their mutants in
them, as many of each file as its share is; chosen at run time (selected.hpp). mutants.json says what each number is. Which are taken
does not depend on the others: a change of the sources changes few of them."""
import glob
import hashlib
import json
import os
import sys

from cplusplus import CppMutator
from generate import write

# Highway compiles it once for each processor, by its own name.
LEFT = {"cmodel/fast/row_kernel.cpp"}
# A template of which only the driver makes anything: its tests try it.
OF_THE_DRIVER = "cmodel/fast/band_walk.hpp"


def sources(root: str, module: str) -> list[str]:
    found = glob.glob(f"{module}/**/*.[ch]pp", root_dir=root, recursive=True)
    found = [path for path in found if path != OF_THE_DRIVER] + [OF_THE_DRIVER] * (module == "driver")
    return sorted(path for path in found if path not in LEFT and "/tools/" not in path)


def mutate(root: str, module: str, wanted=lambda name: True):
    """[(path, text, mutants)] and the number after the last."""
    out, number = [], 1
    for path in sources(root, module):
        with open(f"{root}/{path}") as file:
            mutator = CppMutator(module, path, file.read(), number, wanted)
        text = mutator.result()
        number = mutator.number
        out.append((path, text, mutator.mutants))
    return out, number


def sample(root: str, module: str, count: int, seed: int):
    """The names of so many, as `wanted` has them: those whose hashes are lowest."""
    names = []
    mutate(root, module, names.append)
    return set(sorted(names, key=lambda name: hashlib.sha256(f"{seed}/{name}".encode()).digest())[:count])


def main(words) -> int:
    root, module, out, count, seed = words
    chosen = sample(root, module, int(count), int(seed))
    mutated, _ = mutate(root, module, chosen.__contains__)
    listed = []
    for path, text, mutants in mutated:
        os.makedirs(os.path.dirname(f"{out}/{path}"), exist_ok=True)
        write(f"{out}/{path}", text)
        listed += mutants
    write(f"{out}/mutants.json", json.dumps([vars(m) for m in listed], indent=0))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
