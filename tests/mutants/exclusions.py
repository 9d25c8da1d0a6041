# SPDX-License-Identifier: Apache-2.0
"""exclusions.toml: mutants that no check can see, each with its class and the reason."""
import tomllib

import campaign

CLASSES = {
    "assertion-only": "only an assertion reads it, which says the same of the device without it",
    "equivalent": "the device does the same, whatever it is fed",
    "unseen": "what differs is seen by nobody: a value beside a valid that is low, or one that is overwritten before it is used",
    "power": "only work is saved: a register that could hold is loaded",
    "protocol": "what would show it cannot come: the stream's grammar or a neighbour's promise, asserted or proved, forbids it",
    "unreachable": "no legal configuration builds it",
}


class Exclusions:
    """An entry: module, line (its text, spaces as one), mutants (names, or ["*"]), class, reason, and at (which of them, from 1) where the
    same text is there more than once. ValueError where an entry is not that."""

    def __init__(self, path: str):
        with open(path, "rb") as file:
            self.entries = tomllib.load(file).get("exclusion", [])
        for entry in self.entries:
            missing = {"module", "line", "mutants", "class", "reason"} - set(entry)
            if missing or entry["class"] not in CLASSES or not entry["reason"]:
                raise ValueError(f"{path}: {entry.get('module')}: {entry.get('line')}: "
                                 f"expected module, line, mutants, reason and a class of {', '.join(CLASSES)}")

    def of(self, mutant):
        """The entry that has it, or None."""
        for entry in self.entries:
            if self._matches(entry, mutant):
                return entry
        return None

    def _matches(self, entry, mutant) -> bool:
        return self._on_line(entry, mutant) and (entry["mutants"] == ["*"] or campaign.name_of(mutant) in entry["mutants"])

    def _on_line(self, entry, mutant) -> bool:
        return (entry["module"] == mutant["module"] and entry["line"] == mutant["source"]
                and mutant["nth"] in entry.get("at", [mutant["nth"]]))

    def unused(self, mutants) -> list:
        """Entries, or names in them, that no mutant has."""
        out = []
        for entry in self.entries:
            names = {campaign.name_of(m) for m in mutants if self._on_line(entry, m)}
            if not names or (entry["mutants"] != ["*"] and not set(entry["mutants"]) <= names):
                out.append(entry)
        return out
