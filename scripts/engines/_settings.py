"""What an engine can be told, and what is in force; shared by the adapters, standard library only.

    PARAMETERS = {"stiffness": (1e5, "N/m"), "solref": ([0.02, 1.0], ["s", "1"])}
    OPTIONS = {"iterations": 50, "solver": ("newton", "cg")}

Parameters are the physical numbers of the contact model, value and unit; options are everything
else.  A tuple of words lists the choices, the default first.  `FIXED` names the settings that an
engine documents but does not let its user change.
"""

import math

from _protocol import Unsupported


def in_force(engine, parameters, options, request, fixed=()):
    """{name: value}: the defaults, then the scene's `engines.<engine>`, then the request's."""
    defaults = {name: value for name, (value, _) in parameters.items()} | options
    values = {name: default[0] if isinstance(default, tuple) else default
              for name, default in defaults.items()}
    declared = request.get("scene", {}).get("engines", {}).get(engine) or {}
    for source in (declared, request.get("options") or {}):
        for name, value in source.items():
            if name not in defaults:
                raise ValueError(f"unknown {engine} option {name!r}; known: {sorted(defaults)}")
            value = _checked(name, value, defaults[name])
            if name in fixed and value != values[name]:
                raise Unsupported(f"{name} is fixed at {values[name]} in {engine}")
            values[name] = value
    return values


def _checked(name, value, default):
    """`value` if it is of the kind of `default`; raises ValueError otherwise."""
    if isinstance(default, tuple):
        if value not in default:
            raise ValueError(f"{name} must be one of {', '.join(map(repr, default))}, not {value!r}")
        return value
    if isinstance(default, list):
        if not isinstance(value, list) or len(value) != len(default):
            raise ValueError(f"{name} must be a list of {len(default)} numbers, not {value!r}")
        return [_checked(name, x, 0.0) for x in value]
    if isinstance(default, bool) or isinstance(value, bool):
        if not (isinstance(default, bool) and isinstance(value, bool)):
            raise ValueError(f"{name}: {value!r} is not of the kind of {default!r}")
        return value
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ValueError(f"{name} must be a finite number, not {value!r}")
    if isinstance(default, int) and value != int(value):
        raise ValueError(f"{name} must be a whole number, not {value!r}")
    return int(value) if isinstance(default, int) else value


def contact_model(kind, law, parameters, values):
    """The `contact_model` of a description, with the values in force."""
    return {"kind": kind, "law": law,
            "parameters": {name: {"value": values[name], "unit": unit}
                           for name, (_, unit) in parameters.items()}}


def options_of(options, values):
    """The `options` of a description: every setting that is not a parameter, as in force."""
    return {name: values[name] for name in options}


def require_declared_restitution(engine, scene):
    """For engines without restitution: refuse it unless the scene says which contact to use."""
    material = scene["material"]
    restitutions = [material.get("restitution", 0)]
    restitutions += [pair.get("restitution") or 0 for pair in material.get("pairs", [])]
    if any(restitutions) and not scene.get("engines", {}).get(engine):
        raise Unsupported(f"{engine} has no coefficient of restitution; declare the contact "
                          f"parameters to use instead in the scene's engines.{engine}")
