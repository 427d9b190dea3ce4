"""veritrack track: a recording in, the run of a design's tracker out."""
import csv
import math
import random
import struct
import subprocess
import unittest
import wave

from support import PROGRAM, ROOT, CliTestCase

DESIGN = ROOT / "designs" / "la-scala-1994-figure-3.5-without-leak.toml"
ONE_CHANNEL = ROOT / "designs" / "models" / "type-2-pll.toml"
SAMPLES = 3000


def tone(samples=SAMPLES, noise=1e-4, frequency=0.5, seed=1):
    """In-phase and quadrature samples."""
    generator = random.Random(seed)
    return [(math.cos(frequency * k) + generator.gauss(0, noise), math.sin(frequency * k) + generator.gauss(0, noise))
            for k in range(samples)]


def as_csv(samples, rate=1000):
    return "time,i,q\n" + "".join(f"{k / rate:.6f},{i:.9g},{q:.9g}\n" for k, (i, q) in enumerate(samples))


class Track(CliTestCase):
    def track(self, *arguments, **options):
        return self.run_here("track", *arguments, **options)

    def document(self, folder):
        return (self.folder / folder / "track.md").read_text()

    def rows(self, path):
        with open(self.folder / path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_a_recording_within_the_assumptions(self):
        self.write(as_csv(tone()), "tone.csv")
        result = self.track(DESIGN, "tone.csv", "--strict")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stdout.startswith("tracks-out/tone/track.md: Kept lock; the estimate is 0.5 rad/sample (79.5775 Hz) on "
                                                 "average. "), result.stdout)
        self.assertIn("Tested and kept, as far as estimates tell: signal, amplitude, frequency, slew, noise, samples. Not testable "
                      "here: noise, outside of the samples judged, start.", result.stdout)
        self.assertEqual(self.files(), ["tone.csv", "tracks-out/tone/.design", "tracks-out/tone/track.csv",
                                        "tracks-out/tone/track.md", "tracks-out/tone/track.svg"])
        text = self.document("tracks-out/tone")
        self.assertIn("at 1000 samples per second", text)
        self.assertIn("(79.57", text)  # 0.5 rad/sample in Hz
        rows = self.rows("tracks-out/tone/track.csv")
        self.assertEqual(len(rows), SAMPLES)
        self.assertAlmostEqual(float(rows[-1]["frequency_mean"]), 0.5, delta=0.001)
        self.assertEqual(rows[-1]["state"], "lock")
        self.assertEqual(rows[-1]["first_sample"], str(SAMPLES - 1))

    def test_the_same_recording_gives_the_same_bytes(self):
        self.write(as_csv(tone()), "tone.csv")
        for folder in ("a", "b"):
            self.assertEqual(self.track(DESIGN, "tone.csv", "--out", folder).returncode, 0)
        for name in ("track.md", "track.csv", "track.svg"):
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())

    def test_noise_beyond_the_assumption_is_told_with_its_samples(self):
        samples = tone()
        samples[1500] = (samples[1500][0] + 0.02, samples[1500][1])
        self.write(as_csv(samples), "tone.csv")
        result = self.track(DESIGN, "tone.csv", "--strict")
        self.assertEqual(result.returncode, 1)
        self.assertIn("The recording does not keep to the certificate's assumptions: noise.", result.stdout)
        self.assertIn("| sample 1500 |", self.document("tracks-out/tone"))
        self.assertEqual(self.track(DESIGN, "tone.csv").returncode, 0)

    def test_a_tone_that_ends_is_a_lost_lock(self):
        generator = random.Random(2)
        samples = tone()[:2000] + [(generator.gauss(0, 0.01), generator.gauss(0, 0.01)) for _ in range(1000)]
        self.write(as_csv(samples), "tone.csv")
        result = self.track(DESIGN, "tone.csv", "--strict")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"Lost lock at sample 20\d\d \(2\.0\d+ s\); the estimate is")

    def test_every_sample_in_a_table(self):
        samples = tone()
        text = as_csv(samples[:1000]) + "1.0,,\n" + "".join(
            f"{(1001 + k) / 1000:.6f},{i:.9g},{q:.9g}\n" for k, (i, q) in enumerate(samples[1001:]))
        self.write(text, "tone.csv")
        result = self.track(DESIGN, "tone.csv", "--each", "each.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.rows("each.csv")
        self.assertEqual([int(row["sample"]) for row in rows], list(range(SAMPLES)))
        self.assertEqual(rows[1000]["state"], "gap")
        self.assertEqual(rows[1000]["in_phase"], "")
        self.assertAlmostEqual(float(rows[1000]["frequency"]), 0.5, delta=0.01)
        self.assertAlmostEqual(float(rows[2000]["in_phase"]), samples[2000][0], delta=1e-8)
        self.assertFalse((self.folder / "each.csv.unfinished").exists())
        on_output = self.track(DESIGN, "tone.csv", "--each", "-", "--out", "o")
        self.assertEqual(on_output.stdout.encode(), (self.folder / "each.csv").read_bytes().replace(b"\r\n", b"\n"))
        self.assertIn("Kept lock, apart from gaps; the estimate", on_output.stderr)

    def test_standard_input(self):
        result = self.track(DESIGN, "-", "--out", "o", input=as_csv(tone()))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Kept lock; ", result.stdout)
        self.assertIn("standard input", self.document("o"))
        nameless = self.track(DESIGN, "-", input=as_csv(tone()))
        self.assertEqual(nameless.returncode, 2)
        self.assertIn("--out", nameless.stderr)

    def write_wave(self, name, channels, samples):
        with wave.open(str(self.folder / name), "wb") as file:
            file.setnchannels(channels)
            file.setsampwidth(2)
            file.setframerate(8000)
            file.writeframes(b"".join(struct.pack("<h", round(20000 * value)) for value in samples))

    def test_sound_with_one_channel_gets_a_quadrature_part(self):
        self.write_wave("mono.wav", 1, [i for i, _ in tone()])
        result = self.track(DESIGN, "mono.wav", "--scale", "auto")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Kept lock; ", result.stdout)
        self.assertIn("Hilbert filter of 383 coefficients", self.document("tracks-out/mono"))
        self.assertIn("a sound file has no columns", self.track(DESIGN, "mono.wav", "--columns", "1").stderr)
        unscaled = self.track(DESIGN, "mono.wav", "--out", "unscaled")
        self.assertIn("use --scale auto", self.document("unscaled"))
        self.assertEqual(unscaled.returncode, 0)
        with open(self.folder / "mono.wav", "rb") as file:
            stream = subprocess.run([PROGRAM, "track", DESIGN, "-", "--format", "sound", "--scale", "auto", "--out", "s"],
                                    stdin=file, capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual(stream.returncode, 0, stream.stderr)
        self.assertEqual((self.folder / "s" / "track.csv").read_bytes(),
                         (self.folder / "tracks-out/mono/track.csv").read_bytes())

    def test_sound_with_two_channels(self):
        self.write_wave("stereo.wav", 2, [value for sample in tone() for value in sample])
        refused = self.track(DESIGN, "stereo.wav")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("stereo.wav: a sound file of 2 channels; allowed: --channel from 1 to 2, or --quadrature",
                      refused.stderr)
        result = self.track(DESIGN, "stereo.wav", "--quadrature", "--scale", "1.6384")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Kept lock; ", result.stdout)
        self.assertNotIn("Hilbert", self.document("tracks-out/stereo"))

    def test_models_have_no_innovations_unless_they_are_filters(self):
        frequency = 2 * math.pi * 50 / 10000
        self.write("y\n" + "".join(f"{math.cos(frequency * k):.9g}\n" for k in range(20000)), "tone.csv")
        result = self.track(ROOT / "designs/models/sogi-fll.toml", "tone.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Kept lock; ", result.stdout)
        self.assertNotIn("NIS", result.stdout)
        text = self.document("tracks-out/tone")
        self.assertIn("no covariance", text)
        self.assertIn("(50 Hz)", text)  # by the sample rate of the design
        self.assertEqual(self.rows("tracks-out/tone/track.csv")[-1]["nis_mean"], "")

    def test_bad_recordings_are_told_with_their_place(self):
        self.write("time,i,q\n0,1,0\n1,oops,0\n", "bad.csv")
        result = self.track(DESIGN, "bad.csv")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "bad.csv:3:3: oops; allowed: a finite decimal, or an empty cell or NaN for a "
                                        "missing sample\n")
        self.assertEqual(self.files(), ["bad.csv"])
        self.assertEqual(self.track(DESIGN, "missing.csv").returncode, 2)
        self.assertEqual(self.track("missing.toml", "bad.csv").returncode, 2)

    def test_bad_options(self):
        self.write(as_csv(tone(100)), "tone.csv")
        for options, message in ((("--scale", "big"), "--scale big; allowed: auto, or a number above 0"),
                                 (("--columns", "i,x"), "no column x; nearest: i; allowed: time, i, q"),
                                 (("--start-hz", "5", "--time", "none", "--columns", "i,q"), "needs a sample rate"),
                                 (("--channel", "1"), "tone.csv: no sound file; allowed: --columns"),
                                 (("--format", "mp3"), "--format")):
            result = self.track(DESIGN, "tone.csv", *options)
            self.assertEqual(result.returncode, 2, options)
            self.assertIn(message, result.stderr)

    def test_an_observer_with_a_sampling_interval(self):
        self.write("t,y\n" + "".join(f"{k / 1000:.3f},{2 * math.cos(0.003 * k):.8f}\n" for k in range(20000)), "tone.csv")
        result = self.track(ROOT / "tests/certificates/kkl-sampled.toml", "tone.csv", "--strict")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Tested and kept, as far as estimates tell: signal, amplitude, frequency, slew, noise, samples.", result.stdout)

    def test_an_observer_in_continuous_time_needs_a_sampling_interval(self):
        self.write(as_csv(tone(100)), "tone.csv")
        result = self.track(ROOT / "designs/praly-section-v.toml", "tone.csv", "--columns", "i")
        self.assertEqual(result.returncode, 2)
        self.assertIn("sampling_interval under [design]", result.stderr)

    def test_the_recording_is_never_overwritten(self):
        self.write(as_csv(tone(100)), "track.csv")
        before = (self.folder / "track.csv").read_bytes()
        self.assertEqual(self.track(DESIGN, "track.csv", "--out", ".").returncode, 2)
        self.assertEqual(self.track(DESIGN, "track.csv", "--each", "track.csv", "--out", "o").returncode, 2)
        self.assertEqual((self.folder / "track.csv").read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
