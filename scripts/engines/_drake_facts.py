"""What the installed Drake says of itself.

Names and defaults are read from the module, statements from its own documentation, and nothing is
taken from anywhere else.
"""

import inspect
import re

import pydrake.multibody.plant as plant
from pydrake.multibody.plant import (DiscreteContactApproximation, MultibodyPlant,
                                     MultibodyPlantConfig)
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import LeafSystem


def solver_of(approximation):
    """The solver that a plant takes with an approximation."""
    model = MultibodyPlant(1e-3)
    model.set_discrete_contact_approximation(approximation)
    return model.get_discrete_contact_solver().name


def continuous_integrator():
    """The integrator of a plant without a time step: its class, and whether it controls its error."""
    model = MultibodyPlant(0.0)
    model.Finalize()
    integrator = Simulator(model).get_integrator()
    return {"name": type(integrator).__name__,
            "controls_error": not integrator.get_fixed_step_mode()}


def words(text):
    """The text on one line."""
    return " ".join(text.split())


def documentation(module):
    """Every documentation string of a module and of its classes' members."""
    for _, item in inspect.getmembers(module):
        yield inspect.getdoc(item) or ""
        if inspect.isclass(item):
            yield from (inspect.getdoc(member) or "" for _, member in inspect.getmembers(item))


def found(pattern, text):
    """The first group of a pattern, or nothing."""
    match = re.search(pattern, text)
    return match.group(1) if match else None


def stated():
    """Names, defaults and sentences, none of which may change."""
    told = words(inspect.getdoc(DiscreteContactApproximation))
    everything = words(" ".join(documentation(plant))).lower()
    default = MultibodyPlant(1e-3)
    return {
        "approximations": sorted(DiscreteContactApproximation.__members__),
        "config_approximation": MultibodyPlantConfig().discrete_contact_approximation,
        "default_approximation": default.get_discrete_contact_approximation().name,
        "default_solver": default.get_discrete_contact_solver().name,
        "solvers": {name: solver_of(value) for name, value in
                    sorted(DiscreteContactApproximation.__members__.items())},
        "continuous_integrator": continuous_integrator(),
        "locates_events": hasattr(LeafSystem, "MakeWitnessFunction"),
        "gliding_of": found(r"approximations, (\w+ and \w+) introduce a spurious effect of "
                            r"\"gliding\" in sliding contact", told),
        "gliding_order": found(r"This artifact is (\S+) but", told),
        "without_gliding": found(r"(\w+) does not suffer from this", told),
        "convex": found(r"that the (\w+ and \w+) approximations are convex", told),
        "may_fail": found(r"being non-convex, (\w+) can fail to find a solution", told),
        "dissipation_of_sap": found(r"Dissipation is modeled using a linear (\S+) model", told),
        "tamsi_removed_from": found(r"removed from Drake on or after (\S+)\.", told),
        "mentions": {name: everything.count(name) for name in
                     ("coordinate projection", "midpoint", "contact",
                      "timesteppingrigidbodyplant", "multibodyplant")},
    }
