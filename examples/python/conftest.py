"""The engine that the checks are asked of."""
import pytest
from toy_engine import Toy


@pytest.fixture(scope="session")
def moreau_engine():
    return Toy
