"""Where MuJoCo finds its contacts, step by step, as `contact-geometry/1`.

A step from t_k looks at the configuration at t_k.  Every contact is [body, other, gap, x, y, z]:
the normal points from `other` to `body`, both counted in scene order with the ground as −1, and
(x, y, z) is the point halfway between the two that touch.  In the scenes stored here all normals
are the ground's; how far one is tilted against it is among the `checks`.
"""

import mujoco
import numpy as np

LARGEST_TILT = 1e-6


def geometry_of(model, data, request, engine):
    """The contacts of the first `steps` steps, and the bodies' states at the end."""
    bodies = [model.body(body["name"]).id for body in request["scene"]["bodies"]]
    scene_index = {0: -1} | {body: index for index, body in enumerate(bodies)}
    normal, tilt = np.array(request["scene"]["ground"]["normal"]), 0.0

    def one(contact):
        nonlocal tilt
        tilt = max(tilt, float(np.abs(contact.frame[:3] - normal).max()))
        second, first = (scene_index[int(model.geom_bodyid[geom])]
                         for geom in (contact.geom1, contact.geom2))
        return [first, second, float(contact.dist), *map(float, contact.pos)]

    geometry = []
    for _ in range(request["steps"]):
        mujoco.mj_step(model, data)  # leaves the contacts of the state it started from
        geometry.append([one(contact) for contact in data.contact])
    if tilt > LARGEST_TILT:
        raise ValueError(f"a contact's normal is tilted by {tilt} against the ground's")
    return {"schema": "contact-geometry/1", "scene": request["scene"], "engine": engine,
            "time_step": request["time_step"], "geometry": geometry,
            "end": {"position": data.qpos.tolist(), "velocity": data.qvel.tolist()},
            "checks": {"tilt": tilt}}
