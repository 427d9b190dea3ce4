"""What certify writes for machines, checked against the schemas beside the code that writes it.

python3 documents.py FOLDER STATUS: the documents of a folder, that certify left with this exit status."""

import json
import pathlib
import sys

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]


def validator(kind):
    schema = json.loads((ROOT / f"certificates/document/{kind}.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


VALIDATORS = {kind: validator(kind) for kind in ("certificate", "report")}


def objections(kind, document):
    return ["/".join(map(str, error.path)) + ": " + error.message for error in VALIDATORS[kind].iter_errors(document)]


def read_documents(folder):
    """certificate.json and report.json of a folder, each as its schema says."""
    found = {}
    for kind in VALIDATORS:
        found[kind] = json.loads((folder / f"{kind}.json").read_text())
        wrong = objections(kind, found[kind])
        assert not wrong, wrong
    return found["certificate"], found["report"]


def check_agreement(certificate, report, status):
    """Both say the same of every claim, and the exit status of certify does."""
    required = [claim["verdict"] for claim in report["claims"] if claim["required"]]
    assert status == (0 if all(verdict == "proved" for verdict in required) else 1), (status, required)
    assert (certificate["verdict"] == "nothing-required") == (not required), certificate["verdict"]
    assert certificate["verdict"] == report["verdict"], report["verdict"]
    # Of the claims that are told, those that are decided are claimed, in the same order.
    decided = [(claim["id"], claim["verdict"], claim["required"]) for claim in report["claims"]
               if claim["verdict"] != "undecided"]
    claimed = [(claim["id"], claim["verdict"], claim["required"]) for claim in certificate["claims"]]
    assert claimed == decided, (claimed, decided)


if __name__ == "__main__":
    check_agreement(*read_documents(pathlib.Path(sys.argv[1])), int(sys.argv[2]))
