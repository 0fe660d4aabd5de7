"""The cases of the study: a scene, the way to step it, and what is predicted."""
import dataclasses
import math

ODE_SINGLE = "pbmpi_ode_single"  # pbmpi on ODE in single precision, as in the paper; a build may lack it

# Processors of the sensitivity table, by what they change of Table 3 (pbvalue's keys of --model).
VARIANTS = {
    "Table 3": "",
    "width 4": "width=4",
    "width 16": "width=16",
    "window 64": "window=64",
    "window 512, no clusters": "window=512,clusters=0",
    "no clusters": "clusters=0",
    "branches guessed right": "perfect_branches=1",
    "all accesses hit": "perfect_caches=1",
    "floating point half as long": "fp_add=2,fp_mul=2,fp_div=10,fp_sqrt=14",
    "floating point twice as long": "fp_add=8,fp_mul=8,fp_div=40,fp_sqrt=54",
    "front end twice as long": "front_end=12",
    "ten cycles to execute again": "redo=10",
}


@dataclasses.dataclass
class Case:
    scene: int  # index into the study's scenes
    name: str  # "20Iter", "FVP6", "FEEC+FVP6", ...
    iterations: int  # of quick
    threshold: float = 0.0  # 0: exact
    feec: bool = False  # cycles are the estimate's
    scope: str = "all"
    stepper: str = "quick"
    program: str = "pbmpi"
    has_cycles: bool = True
    has_variants: bool = False  # has rows in the sensitivity table

    @property
    def precision(self):
        return "single" if self.program == ODE_SINGLE else "double"

    def cost(self, bodies):
        """Expected, in arbitrary units. Valgrind takes about as long to start as to step a hundred bodies; cycles take several times as long as hits,
        and a pair of variants the same again."""
        models = 1 + len(VARIANTS) if self.has_variants else 1
        return 100 + bodies * (2 + 5 * models if self.has_cycles and not self.feec else 2)


def threshold_name(threshold):
    """"FVP6" for 1e-6."""
    digits = -math.log10(threshold)
    is_power = abs(digits - round(digits)) < 1e-9 and digits > 0.5
    return f"FVP{round(digits)}" if is_power else f"FVP({threshold:g})"


def engine_cases(scene, name, iterations, threshold, **settings):
    """An exact case, and one with the threshold of Figure 8."""
    return [Case(scene, name, iterations, **settings),
            Case(scene, f"{name} {threshold_name(threshold)}", iterations, threshold, **settings)]


def scene_cases(index, scene, options, has_single):
    """Begins with "20Iter", which also has the cycles of exact prediction (EVP)."""
    iterations, first, full = scene["iterations"], options["thresholds"][0], options["full"]
    fvp = threshold_name(first)
    cases = [Case(index, f"{iterations}Iter", iterations, has_variants=scene["in_detail"]),
             Case(index, f"{iterations - 1}Iter", iterations - 1),
             Case(index, "FEEC", iterations, feec=True),
             Case(index, f"FEEC+{fvp}", iterations, first, feec=True)]
    for threshold in options["thresholds"]:
        cases.append(Case(index, threshold_name(threshold), iterations, threshold, has_cycles=full or threshold == first,
                          has_variants=scene["in_detail"] and threshold == first))
    if scene["in_detail"]:
        cases += [Case(index, f"{fvp} {scope}", iterations, first, scope=scope) for scope in ("collision", "step")]
    cases += engine_cases(index, "sor", iterations, first, stepper="sor", has_cycles=full)
    if has_single:
        cases += engine_cases(index, "single", iterations, first, program=ODE_SINGLE, has_cycles=full)
    return cases


def cases_of(scenes, options, has_single):
    """As dictionaries, scene by scene; each with its `cost`."""
    return [dataclasses.asdict(case) | {"cost": case.cost(scene["bodies"] * scene["worlds"])}
            for index, scene in enumerate(scenes) for case in scene_cases(index, scene, options, has_single)]
