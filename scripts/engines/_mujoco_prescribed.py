"""The velocity of bodies with a prescribed motion in MuJoCo's contacts.

MuJoCo has no velocity for a mocap body: the row i of a contact has (J v)_i of the free bodies alone.
With the frame n, t₁, t₂ of the contact and the velocity w and spin ω of the prescribed body there,
positive on the second geom and negative on the first, the row lacks

    elliptic     n·w, t₁·w, t₂·w, n·ω, t₁·ω, t₂·ω           the first condim of them
    pyramid      n·w ± μ_i d_i ,   i = 1 … condim − 1       d_i the i-th of the others above

and a_ref lacks −b times that, b being MuJoCo's damping of the row.
"""

import numpy as np
import mujoco

from _scene import initial_state

DAMPING = 1  # the place of b among the numbers K, B, I, P of a row


def add_velocities(model, data, prescribed):
    """Complete `efc_vel` and `efc_aref` after `mj_step1`; `prescribed` are bodies by name."""
    elliptic = model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    for contact in data.contact:
        first = contact.efc_address
        if first < 0:
            continue
        lacking = np.zeros(6)
        for geom, sign in ((contact.geom2, 1.0), (contact.geom1, -1.0)):
            body = prescribed.get(model.geom(geom).name)
            if body is not None:
                lacking += sign * _seen(contact, data.geom_xpos[geom], body)
        rows = _rows(lacking, contact, elliptic)
        last = first + len(rows)
        data.efc_vel[first:last] += rows
        data.efc_aref[first:last] -= data.efc_KBIP[first:last, DAMPING] * rows


def _seen(contact, middle, body):
    """Velocity and spin of the body at the contact, in its frame."""
    _, _, linear, angular = initial_state(body)
    velocity = np.array(linear) + np.cross(angular, contact.pos - middle)
    frame = contact.frame.reshape(3, 3)
    return np.concatenate([frame @ velocity, frame @ np.array(angular, dtype=float)])


def _rows(lacking, contact, elliptic):
    used = lacking[:contact.dim]
    if elliptic or contact.dim == 1:
        return used
    sides = contact.friction[:contact.dim - 1] * used[1:]
    return used[0] + np.column_stack([sides, -sides]).ravel()
