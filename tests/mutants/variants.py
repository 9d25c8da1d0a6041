# SPDX-License-Identifier: Apache-2.0
"""What an expression may become. Each variant is a small mistake that somebody could have made: (what, text)."""
import re

from expression import Node

_COMPARISONS = {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!=", ">="],
                "!=": ["==", "<"]}
_SWAPPED = {"+": "-", "-": "+", "*": "+", "/": "*", "%": "/", "<<": ">>", ">>": "<<", ">>>": "<<", "<<<": ">>>",
            "&": "|", "|": "&", "^": "|"}


def binary_variants(node: Node) -> list:
    left, right = (child.text for child in node.children)
    op = node.parser.tokens[node.op].text
    becomes = lambda other: (f"{op} becomes {other}", f"({left}) {other} ({right})")
    out = [becomes(other) for other in _COMPARISONS.get(op, [])]
    if op in _SWAPPED:
        out.append(becomes(_SWAPPED[op]))
    if op in ("&&", "||"):
        out += [becomes("||" if op == "&&" else "&&"), ("without its right side", left), ("without its left side", right)]
    if op in ("-", "<", ">") and left != right:
        out.append(("operands swapped", f"({right}) {op} ({left})"))
    return out


def unary_variants(node: Node) -> list:
    op, inner = node.parser.tokens[node.op].text, node.children[0].text
    if op in ("!", "~", "-"):
        return [(f"without {op}", f"({inner})")]
    if op in ("|", "&"):
        other = "&" if op == "|" else "|"
        return [(f"{op} becomes {other}", f"{other}({inner})")]
    return []


def ternary_variants(node: Node) -> list:
    _, then, otherwise = node.children
    return [("always its first", f"({then.text})"), ("always its second", f"({otherwise.text})")]


def number_variants(text: str) -> list:
    """One more and one less, in the width and base that it has."""
    if text in ("'0", "'1"):
        other = "'1" if text == "'0" else "'0"
        return [(f"{text} becomes {other}", other)]
    match = re.fullmatch(r"(\d+)'(s?)([bdh])([0-9a-fA-F_]+)", text)
    if match:
        width, signed, base, digits = match.groups()
        value = int(digits.replace("_", ""), {"b": 2, "d": 10, "h": 16}[base])
        most = 1 << int(width)
        others = dict.fromkeys([(value + 1) % most, (value - 1) % most])
        return [(f"{text} becomes {other}", f"{width}'{signed}d{other}") for other in others]
    if re.fullmatch(r"\d+", text):
        value = int(text)
        return [(f"{text} becomes {other}", str(other)) for other in ([value + 1, value - 1] if value else [1])]
    return []


def condition_variants(node: Node, true: str, false: str) -> list:
    out = [("always", true), ("never", false)]
    inner = node
    while inner.kind == "group":
        inner = inner.children[0]
    # The negation of a comparison and of a negation comes with the operator itself.
    plain = inner.kind == "unary" or (inner.kind == "binary" and inner.parser.tokens[inner.op].text in ("==", "!="))
    return out if plain else [*out, ("negated", f"!({node.text})")]


def concat_variants(node: Node) -> list:
    parts = [child.text for child in node.children]
    if len(parts) < 2 or parts[0] == parts[1]:
        return []
    swapped = [parts[1], parts[0], *parts[2:]]
    return [("first two swapped", "{" + ", ".join(swapped) + "}")]
