"""Pages, data of figures and tables for LaTeX: certify, map and reproduce with --html, --csv and --latex."""

import base64
import csv
import hashlib
import html.parser
import json
import pathlib
import re
import tempfile
import unittest

from support import DESIGN, CliTestCase, run

FORGED = """<script>alert(1)</script> <img src=x onerror=alert(2)> **PROVED** </title> $`\\href{javascript:x}{y}`$ {{title}}"""


class Page(html.parser.HTMLParser):
    """What is in a page: its text outside of programs, its elements with their attributes, its programs. Every element
    that is opened has to be closed."""

    VOID = {"meta", "link", "br", "hr", "img", "input"}

    def __init__(self, text):
        super().__init__()
        self.elements, self.programs, self.text, self.open = [], [], "", []
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            raise AssertionError(f"</{tag}> in {self.open}")
        self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            self.programs.append(data)
        elif not self.open or self.open[-1] != "style":
            self.text += data

    def words(self):
        return " ".join(self.text.split())


class Pages(CliTestCase):
    @classmethod
    def setUpClass(cls):
        """A certificate with all that can be asked for, which tests look at."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.design = pathlib.Path(folder.name) / "design.toml"
        cls.design.write_text(DESIGN + "\n[require]\nfrequency_error_below = 0.05\n")
        cls.out = pathlib.Path(folder.name) / "out"
        result = run("certify", "--no-verify", cls.design, "--out", cls.out, "--html", "--csv", "--latex")
        assert result.returncode == 0, result.stderr

    def page(self, name):
        text = (self.folder / name).read_text()
        self.check_that_nothing_is_fetched(text)
        return Page(text)

    def check_that_nothing_is_fetched(self, text):
        page = Page(text)
        policy = next(attributes["content"] for tag, attributes in page.elements
                      if tag == "meta" and attributes.get("http-equiv") == "Content-Security-Policy")
        self.assertTrue(policy.startswith("default-src 'none'; "))
        self.assertNotIn("http", policy)
        self.assertNotRegex(policy, r"script-src[^;]*unsafe")
        # Every program is one of those that the policy names.
        allowed = set(re.findall(r"'sha256-([^']*)'", policy))
        scripts = [attributes for tag, attributes in page.elements if tag == "script"]
        self.assertEqual(len(scripts), len(page.programs))
        running = [program for attributes, program in zip(scripts, page.programs) if "type" not in attributes]
        hashes = {base64.b64encode(hashlib.sha256(program.encode()).digest()).decode() for program in running}
        self.assertEqual(hashes, allowed)
        for tag, attributes in page.elements:
            self.assertNotIn(tag, ("iframe", "object", "embed", "link", "img", "base"))
            for name, value in attributes.items():
                self.assertFalse(name.startswith("on"), (tag, name))
                if name in ("src", "srcset", "xlink:href") or (name == "href" and tag != "a"):
                    self.assertTrue(value.startswith("#"), (tag, name, value))
        self.assertNotRegex(text, r"url\((?!data:|&quot;|#)['\"]?https?:")
        self.assertNotIn("@import", text)

    def test_the_page_says_what_the_document_says(self):
        page = self.page(self.out / "certificate.html")
        markdown = (self.out / "certificate.md").read_text()
        sentences = re.findall(r"^(?:- )?\*\*(PROVED|REFUTED)\*\*(?: `(\S+)`| (\(.*?\)))?: (.*)$", markdown, re.MULTILINE)
        self.assertGreaterEqual(len(sentences), 4)
        for verdict, claim, numbers, sentence in sentences:
            behind = claim or numbers
            self.assertIn(f"{verdict}{' ' + behind if behind else ''}: {sentence}", page.words())
        for hypothesis in re.findall(r"^\d\. (.*)$", markdown, re.MULTILINE):
            self.assertIn(hypothesis, page.words())
        headline = markdown.splitlines()[0].removeprefix("# ")
        self.assertIn(headline, page.words())
        self.assertIn("veritrack-verify certificate.json --full --design design.toml --markdown certificate.md "
                      "--markdown published-theorems.md", page.words())
        self.assertIn(hashlib.sha256(markdown.encode()).hexdigest(), page.words())
        figures = [attributes for tag, attributes in page.elements if tag == "svg"]
        self.assertEqual(len(figures), len(re.findall(r"^!\[", markdown, re.MULTILINE)))
        identifiers = [attributes["id"] for _, attributes in page.elements if "id" in attributes]
        self.assertEqual(len(identifiers), len(set(identifiers)))
        for tag, attributes in page.elements:
            if tag == "a":
                self.assertIn(attributes["href"].removeprefix("#"), ["", *identifiers])

    def test_what_a_design_says_is_text(self):
        self.write(DESIGN.replace('"a design"', json.dumps(FORGED)).replace(
            "[design]", f"source = {json.dumps(FORGED)}\n\n[design]"))
        result = self.run_here("certify", "--no-verify", "design.toml", "--out", "out", "--html", "--latex")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.page("out/certificate.html")
        self.assertIn(" ".join(FORGED.split()), page.words())
        self.assertFalse(any("alert(" in program for program in page.programs))
        # Marks of a verdict are there for the sentences only, as in the document.
        marked = [attributes for tag, attributes in page.elements if "verdict" in attributes.get("class", "")]
        documents = "".join((self.folder / "out" / name).read_text() for name in ("certificate.md", "published-theorems.md"))
        ours = len(re.findall(r"\*\*(?:PROVED|REFUTED|UNDECIDED)\*\*", documents.replace(json.dumps(FORGED), "")))
        self.assertEqual(len(marked), ours)

    def test_the_data_of_every_figure(self):
        figures = {path.stem for path in (self.out / "figures").glob("*.svg")}
        for figure in figures:
            raw = (self.out / f"figures/{figure}.csv").read_bytes()
            self.assertEqual(raw.count(b"\n"), raw.count(b"\r\n"))
            rows = list(csv.reader(raw.decode().splitlines()))
            self.assertGreater(len(rows), 10)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])})
            self.assertEqual(rows[0][0], "sample")
            for title in rows[0][1:]:
                self.assertRegex(title, r" \[.+\]$")
        with open(self.out / "figures/tube-levels.csv", newline="") as file:
            levels = {row[0]: float(row[1]) for row in list(csv.reader(file))[1:]}
        self.assertEqual(levels["required"], 0.05)
        # The bound in the file is the one that is certified, to the last bit.
        claims = json.loads((self.out / "certificate.json").read_text())["claims"]
        bound = next(claim["evidence"]["frequency_error_bound"] for claim in claims if claim["id"] == "ekf/guarantee")
        self.assertEqual(levels["certified, assumed starts"], float.fromhex(bound["hi"]))

    def test_tables_for_latex(self):
        text = (self.out / "certificate-tables.tex").read_text()
        tables = re.findall(r"\\begin\{tabular\}.*?\\end\{tabular\}", text, re.DOTALL)
        markdown = (self.out / "certificate.md").read_text()
        self.assertEqual(len(tables), len(re.findall(r"^\| ---", markdown, re.MULTILINE)))
        labels = re.findall(r"\\label\{(.*)\}", text)
        self.assertEqual(len(labels), len(set(labels)))
        for table in tables:
            for part in (r"\toprule", r"\midrule", r"\bottomrule"):
                self.assertEqual(table.count(part), 1)
        # Numbers as in the document: rounded outward there.
        for number in re.findall(r"at (?:most|least) [\d.e-]+ \|", markdown):
            self.assertIn(number.removesuffix(" |"), text)

    def test_same_input_same_bytes_no_paths_and_nothing_that_was_not_asked_for(self):
        self.run_here("certify", "--no-verify", self.design, "--out", "two", "--html", "--csv", "--latex")
        self.run_here("certify", "--no-verify", self.design, "--out", "plain")
        names = [path.relative_to(self.out) for path in self.out.rglob("*") if path.is_file()]
        plain = {path.relative_to(self.folder / "plain") for path in (self.folder / "plain").rglob("*") if path.is_file()}
        self.assertEqual({str(name) for name in set(names) - plain},
                         {"certificate.html", "certificate-tables.tex", "figures/frequency.csv", "figures/error.csv",
                          "figures/error-levels.csv", "figures/tube.csv", "figures/tube-levels.csv"})
        for name in names:
            first = (self.out / name).read_bytes()
            self.assertEqual(first, (self.folder / "two" / name).read_bytes(), name)
            for path in (self.out, self.folder):
                self.assertNotIn(str(path).encode(), first, name)
            if name in plain:
                self.assertEqual(first, (self.folder / "plain" / name).read_bytes(), name)

    def test_without_gnuplot_a_page_has_no_figures(self):
        self.write(DESIGN)
        result = self.run_here("certify", "--no-verify", "design.toml", "--out", "out", "--html", "--csv", env={"PATH": "/nowhere"})
        self.assertIn("without its figures", result.stderr)
        self.assertNotIn("svg", {tag for tag, _ in self.page("out/certificate.html").elements})

    def test_the_map_tells_each_of_its_cells(self):
        self.write(DESIGN.replace("initial_amplitude_error = 0.005", "initial_amplitude_error = 0.0"))
        result = self.run_here("map", "design.toml", "--frequency", "0.3", "--phase", "0.5", "--html", "--out", "map")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.page("map/map.html")
        values = json.loads(next(text for text in page.programs if text.startswith("{")))
        with open(self.folder / "map/region.csv", newline="") as file:
            cells = list(csv.DictReader(file))
        self.assertEqual(len(values["cells"]), len(cells))
        for told, cell in zip(values["cells"], cells):
            for axis, (low, high) in (("frequency_error", told[:2]), ("phase_error", told[2:4])):
                # Not a start more than is proved, and nearly all of them.
                self.assertLessEqual(float(cell[f"{axis}_low"]), float(low))
                self.assertGreaterEqual(float(cell[f"{axis}_high"]), float(high))
                self.assertAlmostEqual(float(cell[f"{axis}_high"]), float(high), delta=1e-4)
            self.assertEqual(told[5], int(cell["samples"]))
            self.assertIn(cell["verdict"], values["kinds"][told[4]])
        self.assertRegex(page.words(), r"PROVED: In double precision .* and is constant, without measurement noise, started "
                         r"with a frequency error and a phase error that lie in a cell that is proved to be captured, within "
                         r"0\.0 of the amplitude and with P\(0\|0\) from ")

    def test_a_report(self):
        result = self.run_here("reproduce", "--seeds", "2", "--out", "report", "--html", "--csv", "--latex")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.page("report/report.html")
        self.assertEqual(len([tag for tag, _ in page.elements if tag == "svg"]), 4)
        self.assertNotIn("The checker does not read", page.words())
        for name in ("figure-2", "figure-3", "near-zero", "start-influence"):
            with open(self.folder / f"report/figures/{name}.csv", newline="") as file:
                self.assertGreater(len(list(csv.reader(file))), 1000)
        self.assertIn(r"\toprule", (self.folder / "report/report-tables.tex").read_text())


if __name__ == "__main__":
    unittest.main()
