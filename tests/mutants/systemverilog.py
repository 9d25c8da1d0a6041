# SPDX-License-Identifier: Apache-2.0
"""Mutants of one SystemVerilog file of rtl/, all in one text: `selected == N ? mutant : original`.

What is mutated: assigned values, conditions, case labels, connections of inputs, values of localparams of type logic, the body
of the narrowing macro; and nonblocking assignments are dropped. What is not: types, widths and generate conditions (they decide what
is built at all), assertions, the FAULT macro with what only it reaches, what only proofs see, nets that gather the unused."""
import re

import variants
from expression import Node, Parser, Unreadable
from tokens import closing, joined, tokens_of

SELECTED = "fastsplat_mutant_pkg::selected"
# Swapped names: one axis for the other.
_AXES = [("x", "y"), ("y", "x"), ("mx", "my"), ("my", "mx"), ("width", "height"), ("height", "width"), ("column", "row"),
         ("row", "column"), ("columns", "rows"), ("rows", "columns")]


class Mutant:
    def __init__(self, number, module, line, source, what, original, text, nth=1):
        """`nth`: which of the file's lines with this text it is on."""
        self.number, self.module, self.line, self.source, self.nth = number, module, line, source, nth
        self.what, self.original, self.text = what, original, text


class Mutator:
    """`number`: of its first mutant. Of those whose number is not `wanted` nothing is left but the number. `planted`: what is wanted is
    there for good, with nothing to choose."""

    def __init__(self, module: str, source: str, number: int, wanted=lambda module, number: True, planted=False):
        self.planted = planted
        self.module, self.source, self.number, self.wanted = module, source, number, wanted
        self.lines = source.split("\n")
        self.tokens = tokens_of(source, "systemverilog")
        self.mutants: list[Mutant] = []
        self.edits: list[tuple[int, int, str]] = []  # characters replaced
        self.declared: dict[str, tuple] = {}  # name -> its declaration: range, sizes, group
        self.enums: list[list[str]] = []
        self.constants: set[str] = set()
        self.at = 0
        self.clocked = False
        self.same: dict = {}

    def result(self) -> str:
        self._declarations()
        while self.at < len(self.tokens):
            self._item()
        out, at = [], 0
        for start, end, text in sorted(self.edits):
            assert start >= at, (self.module, text)
            out += [self.source[at:start], text]
            at = end
        return "".join(out) + self.source[at:]

    # ---- mutants

    def _add(self, node_line: int, what: str, original: str, text: str) -> int | None:
        """Its number if it is wanted. The second of the same on a line says so: (2)."""
        self.number += 1
        same = self.same[(node_line, what, original)] = self.same.get((node_line, what, original), 0) + 1
        what += f" ({same})" if same > 1 else ""
        if not self.wanted(self.module, self.number - 1):
            return None
        texts = [" ".join(line.strip(" \\").split()) for line in self.lines[:node_line]]
        self.mutants.append(Mutant(self.number - 1, self.module, node_line, texts[-1], what, original, text, texts.count(texts[-1])))
        return self.number - 1

    def _choice(self, node: Node, found: list, original: str) -> str:
        """The text of `node`, rewritten to `original`, beside its variants."""
        out, seen = "", {node.text}
        for what, text in found:
            if text in seen:
                continue
            seen.add(text)
            number = self._add(node.line, what, node.text, text)
            if number is not None and self.planted:
                return f"({text})"
            if number is not None:
                out += f"{SELECTED} == {number} ? ({text}) : "
        return f"({out}({original}))" if out else original

    def _mutate(self, node: Node, extra=()) -> str:
        if _fault(node) is not None:
            return node.text
        skipped, found = set(), list(extra)
        if node.kind == "binary":
            fixed = [child for child in node.children if _fault(child) is not None]
            skipped.update(fixed)
            if not fixed:
                found += variants.binary_variants(node)
        elif node.kind == "unary":
            found += variants.unary_variants(node)
        elif node.kind == "ternary":
            condition, then, otherwise = node.children
            fault = _fault(condition)
            if fault is None:
                found += variants.ternary_variants(node)
            else:
                skipped.update([condition, otherwise if fault else then])
        elif node.kind == "number":
            found += variants.number_variants(node.text)
        elif node.kind == "concat":
            found += variants.concat_variants(node)
        elif node.kind == "name":
            found += self._name_variants(node)
        elif node.kind == "repeat":
            skipped.update(node.children)  # how often is a constant
        elif node.kind == "slice" and not node.children:
            found += self._slice_variants(node)
        texts = {child: self._mutate(child) for child in node.children if child not in skipped}
        return self._choice(node, found, node.with_children(texts))

    def _slice_variants(self, node: Node) -> list:
        whole, low = node.text, self.tokens[node.end - 2]
        if self.tokens[node.end - 3].text != ":" or low.kind != "number":
            return []
        return [("a bit higher", f"({whole}) >> 1")] if low.text == "0" else [("a bit lower", f"({whole}) << 1")]

    def _name_variants(self, node: Node) -> list:
        name = node.text
        for group in self.enums:
            if name in group:
                other = group[(group.index(name) + 1) % len(group)]
                return [(f"{name} becomes {other}", other)]
        if name in self.constants or name.startswith("fastsplat_pkg"):
            return [("one more", f"{name} - 1'sb1")]  # as signed as the constant
        kind = self.declared.get(name)
        if kind is None:
            return []
        out = []
        for old, new in _AXES:
            other = re.sub(rf"(?<![a-z]){old}(?![a-z])", new, name)
            if other != name and self.declared.get(other, (None, None))[:2] == kind[:2]:
                out.append((f"{name} becomes {other}", other))
        siblings = [n for n, d in self.declared.items() if d == kind]
        # Only of registers' values: elsewhere it could close a loop of gates.
        if len(siblings) > 1 and self.clocked:
            other = siblings[(siblings.index(name) + 1) % len(siblings)]
            out.append((f"{name} becomes {other}", other))
        return out

    # ---- expressions in their places

    def _expression(self, end: int, extra=lambda node: []) -> Node | None:
        """That of tokens[at:end], rewritten; goes on behind it. What the grammar does not know stays as it is."""
        parser = Parser(self.tokens, self.at, end)
        start, self.at = self.at, end
        try:
            node = parser.ternary()
            if parser.at != end:
                raise Unreadable(f"{parser.peek()!r} left over")
        except Unreadable as error:
            raise ValueError(f"{self.module}: line {self.tokens[start].line}: {error}") from error
        before = len(self.mutants)
        text = self._mutate(node, extra(node))
        if len(self.mutants) > before:
            self.edits.append((self.tokens[start].start, self.tokens[end - 1].end, text))
        return node

    def _until(self, *ends: str) -> int:
        """Index of the next token of these outside all brackets."""
        i = self.at
        while self.tokens[i].text not in ends or self.tokens[i].kind == "string":
            i = closing(self.tokens, i) + 1 if self.tokens[i].text in ("(", "[", "{") else i + 1
        return i

    def _skip_to(self, *ends: str):
        self.at = self._until(*ends) + 1

    def _text(self, ahead=0) -> str:
        return self.tokens[self.at + ahead].text if self.at + ahead < len(self.tokens) else ""

    # ---- declarations

    def _declarations(self):
        """Names by what they are declared as: [31:0] a, b; and ports. Only such are swapped."""
        text = joined(self.tokens)
        for match in re.finditer(r"typedef enum[^{]*\{([^}]*)\}", text):
            self.enums.append([name.strip() for name in match.group(1).split(",")])
        for match in re.finditer(r"\blocalparam [^;]*;", text):
            self.constants.update(re.findall(r"([A-Z][\w`]*) =", match.group()))
        group = 0
        for match in re.finditer(r"(?:(input|output) )?\b(?:wire|logic) ((?:signed )?(?:\[[^;,]*?\] )?)([a-z_]\w*(?:\[[^\]]*\])?(?:, [a-z_]\w*(?:\[[^\]]*\])?(?= ?[,;]))*)", text):
            group += 1
            for name in re.findall(r"([a-z_]\w*)(\[[^\]]*\])?", match.group(3)):
                # Ports stand alone: their axis names are their only siblings.
                self.declared[name[0]] = (match.group(2), name[1], group)
        for name in ("clk_i", "rst_ni"):
            self.declared.pop(name, None)

    # ---- items of a module

    def _item(self):
        token = self.tokens[self.at]
        text = token.text
        if token.kind == "macro":
            return self._macro()
        if text in ("module", "typedef", "genvar", "import", "parameter"):
            return self._skip_to(";")
        if text in ("endmodule", "end", "else", ";", "begin"):
            self.at += 1
            if text == "begin" and self._text() == ":":
                self.at += 2
            return None
        if text == "for":  # a generate loop
            self.at = closing(self.tokens, self.at + 1) + 1
            return None
        if text == "if":  # a generate condition
            self.at = closing(self.tokens, self.at + 1) + 1
            return None
        if text == "localparam":
            return self._localparam()
        if text == "assign":
            self.at += 1
            return self._assignment(drop=False)
        if text in ("always_ff", "always_comb"):
            self.at += 1
            if self._text() == "@":
                self.at = closing(self.tokens, self.at + 1) + 1
            self.clocked = text == "always_ff"
            self._statement(drop=self.clocked)
            self.clocked = False
            return None
        if text == "function" and self._text(2) == "int":  # a width
            return self._skip_to("endfunction")
        if text == "function":
            self._skip_to(";")
            while self._text() != "endfunction":
                self._statement(drop=False)
            self.at += 1
            return None
        if text in ("logic", "wire", "int"):
            return self._skip_to(";")
        if token.kind == "name" and self._text(2) in (";", ","):  # of a type with a name
            return self._skip_to(";")
        if token.kind == "name":
            return self._instance()
        if text == "(":  # what follows a macro's name
            self.at = closing(self.tokens, self.at) + 1
            return None
        raise ValueError(f"{self.module}: line {token.line}: what is {text!r}?")

    def _macro(self):
        text = self._text()
        if text in ("`ifdef", "`ifndef"):
            # Guards are open; what only a proof sees is not.
            guard = self._text(1)
            self.at += 2
            if guard == "FASTSPLAT_PROOF":
                while self._text() not in ("`else", "`endif"):
                    self.at += 1
                self.at += 1
        elif text == "`include":
            self.at += 2
        elif text == "`define" and self._text(1) == "FASTSPLAT_NARROW":
            self.at = closing(self.tokens, self.at + 2) + 1
        elif text == "`define":
            line = self.tokens[self.at].line
            while self.at < len(self.tokens) and self.tokens[self.at].line == line:
                self.at += 1
        elif text in ("`else", "`endif"):
            self.at += 1
        else:
            self.at = closing(self.tokens, self.at + 1) + 1 if self._text(1) == "(" else self.at + 1
            if self._text() == ";":
                self.at += 1

    def _localparam(self):
        start = self.at
        if self._text(1) != "logic":
            return self._skip_to(";")
        end = self._until(";")
        # A constant with a mutant is a net.
        kind_start = self.at + 1
        while not (self.tokens[self.at].kind == "name" and self._text(1) == "="):
            self.at += 1
            if self._text() == "[":
                self.at = closing(self.tokens, self.at) + 1
        kind = joined(self.tokens[kind_start:self.at])
        out, before = "", len(self.mutants)
        while True:
            name = self._text()
            self.at += 2
            parser = Parser(self.tokens, self.at, self._until(",", ";"))
            node = parser.ternary()
            self.at = parser.at
            value = self._mutate(node)
            out += f"localparam {kind} {name} = {value}; " if self.planted else f"{kind} {name}; assign {name} = {value}; "
            if self._text() == ";":
                break
            self.at += 1
        self.at = end + 1
        if len(self.mutants) > before:
            self.edits.append((self.tokens[start].start, self.tokens[end].end, out))
        return None

    def _instance(self):
        if self._text(1) == "#":
            self.at = closing(self.tokens, self.at + 2) + 1
        else:
            self.at += 1
        self.at += 1  # its own name
        end = closing(self.tokens, self.at)
        self.at += 1
        while self.at < end:
            if self._text() == "." and self._text(2) == "(":
                port, close = self._text(1), closing(self.tokens, self.at + 2)
                self.at += 3
                if port.endswith("_o") or self._text() == ")":
                    self.at = close
                else:
                    self._expression(close)
            self.at += 1
        self.at = end + 2

    # ---- statements

    def _statement(self, drop: bool):
        token = self.tokens[self.at]
        text = token.text
        if text == "begin":
            self.at += 1
            if self._text() == ":":
                self.at += 2
            while self._text() != "end":
                self._statement(drop)
            self.at += 1
        elif text == "if":
            self._if(drop)
        elif text == "for":
            self.at = closing(self.tokens, self.at + 1) + 1
            self._statement(drop)
        elif text == "case":
            self._case(drop)
        elif token.kind == "macro":
            self._macro()
        elif text in ("logic", "int"):
            self._skip_to(";")
        elif text == ";":
            self.at += 1
        else:
            self._assignment(drop)

    def _if(self, drop: bool):
        self.at += 1
        end = closing(self.tokens, self.at)
        self.at += 1
        node = self._expression(end, lambda n: variants.condition_variants(n, "1'b1", "1'b0") if _reaches(n) else [])
        self.at += 1
        if _fault(node) is False:
            self._skip_statement()
        else:
            self._statement(drop)
        if self._text() == "else":
            self.at += 1
            self._statement(drop)

    def _skip_statement(self):
        edits, mutants, number = len(self.edits), len(self.mutants), self.number
        self._statement(False)
        del self.edits[edits:], self.mutants[mutants:]
        self.number = number

    def _case(self, drop: bool):
        self.at += 1
        end = closing(self.tokens, self.at)
        self.at += 1
        self._expression(end)
        self.at += 1
        labels = []  # (first token, last token + 1), a list for each item
        while self._text() != "endcase":
            if self._text() == "default":
                self.at += 2
            else:
                colon = self._until(":")
                item = [self.at]
                for i in range(self.at, colon):
                    if self.tokens[i].text == "," :
                        item.append(i + 1)
                item.append(colon + 1)
                labels.append([(a, b - 1) for a, b in zip(item, item[1:])])
                self.at = colon + 1
            self._statement(drop)
        self.at += 1
        for n, item in enumerate(labels):
            start, end = labels[(n + 1) % len(labels)][0]
            other = joined(self.tokens[start:end])
            for first, last in item:
                label = joined(self.tokens[first:last])
                if label == other:
                    continue
                number = self._add(self.tokens[first].line, f"label {label} becomes {other}", label, other)
                if number is None:
                    continue
                self.edits.append((self.tokens[first].start, self.tokens[last - 1].end, other if self.planted else
                                   f"({SELECTED} == {number} ? {other} : {label})"))

    def _assignment(self, drop: bool):
        start = self.at
        target = self._until("=", "<=")
        unused = joined(self.tokens[start:target]).startswith("unused")
        self.at = target + 1
        end = self._until(";")
        if unused:
            self.at = end + 1
            return
        self._expression(end)
        self.at = end + 1
        if drop:
            text = joined(self.tokens[start:end])
            number = self._add(self.tokens[start].line, "dropped", text, "")
            if number is None:
                return
            at, close = self.tokens[start].start, self.tokens[end].end
            if self.planted:
                self.edits.append((at, close, ";"))
                return
            self.edits.append((at, at, f"begin if ({SELECTED} != {number}) "))
            self.edits.append((close, close, " end"))


def _fault(node: Node):
    """False or True where only the FAULT macro decides; None elsewhere."""
    if node.kind == "macro":
        return False if node.text.startswith("`FASTSPLAT_FAULT") else None
    if node.kind == "group":
        return _fault(node.children[0])
    if node.kind == "unary" and node.parser.tokens[node.op].text == "!":
        inner = _fault(node.children[0])
        return None if inner is None else not inner
    if node.kind == "binary" and node.parser.tokens[node.op].text in ("&&", "||"):
        stops = node.parser.tokens[node.op].text == "||"
        sides = [_fault(child) for child in node.children]
        if stops in sides:
            return stops
        return None if None in sides else not stops
    return None


def _reaches(node: Node) -> bool:
    """The whole condition is worth changing: no side of it is the FAULT macro's."""
    return _fault(node) is None
