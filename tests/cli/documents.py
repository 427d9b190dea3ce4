"""What certify writes for machines, checked against the schemas beside the code that writes it."""

import json

import jsonschema
from support import ROOT


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
