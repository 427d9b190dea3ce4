#!/usr/bin/python3
"""Stands in for veritrack-engine where a test is about sweeps: it answers at once, with numbers made of q1 and r.

A design with q1 = 0.666 ends it, as a crash would.
"""

import hashlib
import json
import os
import sys
import tomllib


def claim(name, sense, value):
    return {"id": "ekf/guarantee", "verdict": "proved", "statement": "", "requirement": "", "required": False,
            "reason": "", "line": 0, "column": 0,
            "quantities": {name: {"lo": value.hex(), "hi": value.hex(), "sense": sense, "words": name,
                                  "symbol": ""}}}


def answer(request):
    if request["do"] == "page":
        return {"html": "<html></html>"}
    design = tomllib.loads(request["text"])
    if request["do"] == "read":
        return {"name": design["name"], "tracker": design["tracker"], "positions": {}}
    q1, r = design["design"]["q1"], design["design"]["r"]
    if q1 == 0.666:
        os.abort()
    if q1 < 0:
        return {"error": {"kind": "input", "file": request["file"], "line": 5, "column": 6, "message": "q1 below 0"}}
    return {"files": {"certificate.json": "{}", "certificate.md": ""},
            "verdict": "proved" if q1 * r < 0.5 else "undecided", "headline": "",
            "certificate_sha256": hashlib.sha256(request["text"].encode()).hexdigest(),
            "claims": [claim("frequency_error_bound", "at most", float(q1 * r))]}


print(json.dumps({"version": "0", "identity": "stand-in " + os.environ.get("STAND_IN_VERSION", "1"),
                  "failures": []}), flush=True)
for line in sys.stdin:
    print(json.dumps(answer(json.loads(line))), flush=True)
