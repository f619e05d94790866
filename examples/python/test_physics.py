"""One test per check and time step: `moreau_check` is given by the plugin of moreau-contact."""


def test_physics(moreau_check):
    moreau_check()
