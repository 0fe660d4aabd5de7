"""Numbers as words: what cells and sentences have in common."""
import math

import numpy as np

NO_NUMBER = "-"


def percent(share, decimals=1):
    """"12.3 %"; "-" for what is not finite."""
    if not math.isfinite(share):
        return NO_NUMBER
    return f"{100 * share:z.{decimals}f} %"  # z: no minus before a zero


def number(value, form, scale=1):
    """In a form such as ".3g", or "-" for what is not finite or None."""
    return f"{scale * value:{form}}" if value is not None and math.isfinite(value) else NO_NUMBER


def plural(count, noun, several=""):
    """`several`: the noun's plural, if not with an s."""
    return f"{count} {noun if count == 1 else several or noun + 's'}"


def stepper_in(setting):
    """"sor single" of "sor single, 14 x 1", as studies write a setting in short."""
    return setting.partition(",")[0]


def short(value):
    """A number with the fewest digits that read back to it, in the shorter of its two forms (0.001, 1e-04); a text as it is."""
    if not isinstance(value, float) or not math.isfinite(value):
        return str(value)
    plain, scientific = np.format_float_positional(value, trim="-"), np.format_float_scientific(value, trim="-")
    return scientific if len(scientific) < len(plain) else plain


def joined(names, most):
    """The first `most` names, and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
