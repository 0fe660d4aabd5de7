"""Python values as the text that pbmpi reads: options of a step, and TOML."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any


def plain(value: Any) -> Any:
    """A numpy scalar or array as Python's own numbers and lists."""
    return value.tolist() if hasattr(value, "tolist") else value


def option_text(name: str, value: Any) -> str:
    """The value of an option as on pbmpi's command line. A dict {"friction": False} is for `effects`.

    TypeError for a value that no option has.
    """
    value = plain(value)
    if isinstance(value, str):
        return value
    if isinstance(value, Mapping) and all(isinstance(chosen, bool) for chosen in value.values()):
        return ",".join(("+" if chosen else "-") + effect for effect, chosen in value.items())
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return repr(value)
    raise TypeError(f"{name}={value!r}: an option is a number, a text as on pbmpi's command line, or for effects a dict "
                    "such as {'friction': False}")


def settings_text(settings: Mapping[str, Any]) -> dict[str, str]:
    """Options by their names in pbmpi: `solver_seed` is its --solver-seed."""
    return {name.replace("_", "-"): option_text(name, value) for name, value in settings.items()}


def toml_text(value: Any) -> str:
    """A Python value as TOML. TypeError for one that TOML does not have."""
    value = plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return repr(value)
    if isinstance(value, float):
        return "nan" if math.isnan(value) else repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {toml_text(item)}" for key, item in value.items()) + " }"
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    raise TypeError(f"{value!r} is no value of a scene: numbers, texts, bools, and lists and dicts of these are")


def parameter_texts(parameters: Any, num_worlds: int) -> list[dict[str, str]]:
    """What each world has otherwise than the scene, from a dict a world (None: nothing) or a dict of columns.

    ValueError for another number of worlds than `num_worlds`; 0: any.
    """
    if parameters is None:
        return []
    if isinstance(parameters, Mapping) or hasattr(parameters, "columns"):
        columns = {name: list(parameters[name]) for name in parameters}
        lengths = {name: len(column) for name, column in columns.items()}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"parameters: the columns must be equally long, a value a world; they are {lengths}")
        parameters = [dict(zip(columns, row)) for row in zip(*columns.values())]
    if num_worlds and len(parameters) != num_worlds:
        raise ValueError(f"parameters: they are {len(parameters)}; there must be one dict (or value of a column) for each of "
                         f"the {num_worlds} worlds")
    return [{name: toml_text(value) for name, value in (one or {}).items()} for one in parameters]
