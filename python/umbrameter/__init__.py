"""Runs umbrameter, which measures the error of real-time shadows and ambient occlusion, and reads its results."""
from . import plot
from .exr import Layers
from .measure import Difference, compare, diff, evaluate, sweep, tune
from .objective import Evaluation, Objective, objective
from .parameters import Parameter, parameters, program_version
from .program import Error, find_program
from .results import Figure, Quantity, Run, load

__version__ = program_version
__all__ = ["Difference", "Error", "Evaluation", "Figure", "Layers", "Objective", "Parameter", "Quantity", "Run", "compare",
           "diff", "evaluate", "find_program", "load", "objective", "parameters", "plot", "sweep", "tune"]
