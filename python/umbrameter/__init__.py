"""Runs umbrameter, which measures the error of real-time shadows and ambient occlusion, and reads its results."""
from . import plot
from .budget import Check, CheckResult, check, update_budget
from .exr import Layers
from .measure import Difference, compare, diff, evaluate, info, raster, report, sweep, trace, tune
from .objective import Evaluation, Objective, objective
from .parameters import Parameter, parameters, program_version
from .program import Error, find_program
from .results import Figure, Quantity, Run, load

__version__ = program_version
__all__ = ["Check", "CheckResult", "Difference", "Error", "Evaluation", "Figure", "Layers", "Objective", "Parameter", "Quantity",
           "Run", "check", "compare", "diff", "evaluate", "find_program", "info", "load", "objective", "parameters", "plot",
           "raster", "report", "sweep", "trace", "tune", "update_budget"]
