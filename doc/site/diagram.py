"""Diagrams of pages: a flowchart in the subset of Mermaid that the pages use, drawn by Graphviz as SVG."""
import html
import re
import subprocess

_NODE = re.compile(r'([\w]+)(?:\["([^"]*)"\])?')


def dot(text):
    """The graph of a flowchart as text for Graphviz. A node lies in the group in which it begins an arrow or stands
    alone, or else in the first that names it.

    Raises ValueError for a line that it does not know.
    """
    labels, first, groups, edges, group = {}, {}, {}, [], None
    for line in text.strip().strip("`").splitlines():
        line = line.strip()
        if line.startswith("subgraph "):
            group = line.removeprefix("subgraph ")
        elif line == "end":
            group = None
        elif line and not line.startswith(("mermaid", "flowchart")):
            for statement in line.split(";"):
                chain = [[_name(node, labels) for node in side.split(" & ")] for side in statement.split("-->")]
                for node in sum(chain, []):
                    first.setdefault(node, group)
                groups.update({node: group for node in chain[0] if not groups.get(node)})
                edges += [(a, b) for left, right in zip(chain, chain[1:]) for a in left for b in right]
    groups = {node: groups.get(node) or of for node, of in first.items()}
    lines = ["digraph {", "bgcolor=transparent; nodesep=.15; node [shape=box, style=rounded, fontsize=11, height=.3]; edge [arrowsize=.6]"]
    for name in dict.fromkeys(filter(None, groups.values())):
        members = " ".join(node for node, of in groups.items() if of == name)
        lines.append(f'subgraph "cluster_{name}" {{ label="{name}"; style=rounded; {members} }}')
    lines += [f'{node} [label="{label}"]' for node, label in labels.items()]
    return "\n".join(lines + [f"{a} -> {b}" for a, b in edges] + ["}"])


def _name(text, labels):
    """The name of a node, whose label, if there is one, is added."""
    node = _NODE.fullmatch(text.strip())
    if not node:
        raise ValueError(f"'{text.strip()}' is no node of a flowchart: a name, or name[\"text\"]")
    if node[2]:
        labels[node[1]] = html.unescape(node[2])
    return node[1]


def svg(text):
    """The flowchart as an SVG element in one line, without a fixed size."""
    drawn = subprocess.run(["dot", "-Tsvg"], input=dot(text), check=True, capture_output=True, text=True).stdout
    drawn = re.sub(r"<!--.*?-->", "", drawn[drawn.index("<svg"):], flags=re.DOTALL)
    return " ".join(drawn.split())
