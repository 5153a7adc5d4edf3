"""Errors for arguments of a wrong type or range: they name the argument, what it must be, and an example."""
import numbers
import os
import re

SEED_MAX = 2**64 - 1

# What an argument must be, and an example, by its name: where its type alone does not say it.
_KNOWN = {
    "seed": ("a whole number, 0 to 2^64 - 1", "1"),
    "period_s": ("a number of seconds in (0, 1]", "0.1"),
    "threads": ("a whole number, 1 to 1024", "2"),
    "world": ("a World", 'robosim.World.load("small_maze")'),
    "file": ("a str or a path", '"small_maze"'),
    "folder": ("a str or a path", '"."'),
    "kind": ("a str", '"sonar"'),
    "sensor": ("a str", '"sonar"'),
    "types": ("a list of str", '["pioneer3dx"]'),
    "controller": ("a str", '"wander"'),
    "controllers": ("a dict of names of robots", '{"R1": "wander"}'),
    "color": ("three numbers in [0, 1]", "(1, 0.8, 0)"),
    "state": ("the bytes that save() has returned", "simulation.save()"),
    "text": ("a str", '"hello"'),
}
# The same, of one function only.
_KNOWN_OF = {
    ("generate", "kind"): ('"maze", "cave", "office" or "open"', '"maze"'),
    ("WorldGenerator", "kind"): ('"maze", "cave", "office" or "open"', '"maze"'),
    ("parse", "text"): ("a str", '"<world>…</world>"'),
    ("parse", "name"): ("a str", '"world"'),
    ("record", "file"): ("a str or a path", '"run.rawlog"'),
    ("read_rawlog", "file"): ("a str or a path", '"run.rawlog"'),
    ("write", "file"): ("a str or a path", '"world.xml"'),
    ("load_plugin", "file"): ("a str or a path", '"plugin.so"'),
}
_BY_TYPE = {
    "str": ("a str", '"R1"', lambda x: isinstance(x, str)),
    "float": ("a number", "0.5", lambda x: isinstance(x, numbers.Real) or hasattr(x, "__float__")),
    "int": ("a whole number", "1", lambda x: hasattr(x, "__index__")),
    "bool": ("True or False", "True", lambda x: isinstance(x, bool)),
    "bytes": ("bytes", 'b"…"', lambda x: isinstance(x, bytes)),
    "dict": ("a dict", "{}", lambda x: isinstance(x, dict)),
    "os.PathLike": ("a str or a path", '"maze.xml"', lambda x: isinstance(x, (str, bytes, os.PathLike))),
    "List[str]": ("a list of str", '["R1"]',
                  lambda x: isinstance(x, (list, tuple)) and all(isinstance(of, str) for of in x)),
}


def _type_of(value):
    """Such as "int", or "list of int, str" with the types of the elements."""
    if isinstance(value, (list, tuple)) and value:
        return f"{type(value).__name__} of {', '.join(sorted({type(of).__name__ for of in value}))}"
    return type(value).__name__


def refuse(name, value, what, example):
    """Raises TypeError for a value of a wrong type."""
    raise TypeError(f"{name} must be {what}, not {_type_of(value)}; for example {example}")


def require_whole(name, value, least, most, example=1):
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}; it must be {_range(least, most)}, "
                        f"for example {example}")
    if not least <= value <= most:
        raise ValueError(f"{name} is {value}; it must be {_range(least, most)}, for example {example}")


def _range(least, most):
    return f"{least} to {'2^64 - 1' if most == SEED_MAX else most}"


def require_number(name, value, what, example):
    """The range is checked elsewhere. what: its range with its unit: "a number of seconds in (0, 1]"."""
    if isinstance(value, (bool, str)) or not isinstance(value, numbers.Real):
        refuse(name, value, what, example)


def _split(text):
    """The parts of a list that are separated by commas outside of brackets and quotes."""
    parts, depth, quote, begin = [], 0, "", 0
    for at, character in enumerate(text):
        if quote:
            quote = "" if character == quote else quote
        elif character in "'\"":
            quote = character
        elif character in "([{<":
            depth += 1
        elif character in ")]}>":
            depth -= 1
        elif character == "," and depth == 0:
            parts.append(text[begin:at].strip())
            begin = at + 1
    return [part for part in (*parts, text[begin:].strip()) if part]


def _parameters(signature):
    """Name, type and whether it is required of each parameter of pybind11's signature; names of keyword-only ones."""
    parameters, keyword_only, may_be_positional = [], set(), True
    for part in _split(signature):
        if part.startswith("*"):
            may_be_positional = False
            continue
        declared, _, default = part.partition(" = ")
        name, _, of_type = declared.partition(": ")
        parameters.append((name, of_type, not default))
        if not may_be_positional:
            keyword_only.add(name)
    return parameters, keyword_only


def _fits(of_type, value):
    optional = re.fullmatch(r"Optional\[(.*)\]", of_type)
    if optional:
        return value is None or _fits(optional.group(1), value)
    if of_type in _BY_TYPE:
        return _BY_TYPE[of_type][2](value)
    if of_type.startswith("robosim._robosim."):
        return any(base.__name__ == of_type.rpartition(".")[2] for base in type(value).__mro__)
    return True


def _expected(function, name, of_type):
    if (function, name) in _KNOWN_OF:
        return _KNOWN_OF[function, name]
    if name in _KNOWN:
        return _KNOWN[name]
    plain = re.sub(r"Optional\[(.*)\]", r"\1", of_type)
    if plain in _BY_TYPE:
        return _BY_TYPE[plain][:2]
    sequence = re.match(r"(?:Tuple|List|Annotated)\[(.*)\]", plain)
    if sequence:
        return f"a sequence of {sequence.group(1)}", "(1, 0.5, 0)"
    return f"of type {plain.rpartition('.')[2]}", "that of the documentation"


def explain(text, arguments, keywords):
    """A text for the error that pybind11 raises for arguments of the wrong types. None: it is another error."""
    found = re.match(r"_?(\w+)\(\): incompatible (?:function|constructor) arguments[^\n]*\n    1\. ([\w.]*)\((.*)\)", text)
    if not found or "\n    2. " in text:
        return None
    function, made, signature = found.groups()
    function = made.rpartition(".")[2] or function
    parameters, keyword_only = _parameters(re.sub(r"\) -> .*", "", signature))
    has_others = "**" in signature
    given = list(arguments)
    if made or parameters and parameters[0][0] == "self":
        given = given[1:]
        parameters = parameters if made else parameters[1:]
    names = [name for name, _, _ in parameters]
    listed = ", ".join(names)
    positional = [parameter for parameter in parameters if parameter[0] not in keyword_only]
    if len(given) > len(positional):
        return f"{function}() takes {len(positional)} positional arguments, not {len(given)}; its arguments are {listed}"
    values = {name: value for (name, _, _), value in zip(positional, given)}
    for name, value in keywords.items():
        if name not in names and not has_others:
            return f"{function}() has no argument '{name}'; its arguments are {listed}"
        if name in values:
            return f"{function}() has two values for its argument {name}"
        values[name] = value
    for name, of_type, is_required in parameters:
        what, example = _expected(function, name, of_type)
        label = "the argument" if name.startswith("arg") else name
        if name not in values:
            if is_required:
                return f"{function}() requires the argument {name}: {what}, for example {name}={example}"
        elif not _fits(of_type, values[name]):
            return (f"{function}(): {label} must be {what}, not {_type_of(values[name])}; "
                    f"for example {name}={example}")
    return None
