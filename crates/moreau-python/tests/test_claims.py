"""The claims as records."""
import json

import moreau_contact as mc
import pytest


def test_the_claims_are_those_of_the_command(command):
    claims = mc.claims()
    assert claims == json.loads(command("verify", "--list", "--format", "json"))
    assert len({claim["id"] for claim in claims}) == len(claims) == 411


def test_a_claim_is_judged_as_the_command_does(command):
    (ours,) = mc.verify("s4.copos-plus")
    (theirs,) = json.loads("[" + command("verify", "--explain", "S4.copos-plus", "--format", "json") + "]")
    assert {**ours, "seconds": 0} == {**theirs, "seconds": 0} and ours["status"] == "supported"


def test_words_search_and_unknown_ids_are_told():
    found = mc.claims("copositive")
    assert 0 < len(found) < 411 and all("copositive" in json.dumps(claim, ensure_ascii=False).lower() for claim in found)
    for wrong in ["S4.copos-minus", []]:
        with pytest.raises(mc.InvalidInput):
            mc.verify(wrong)
