"""What veritrack track says of ten synthetic recordings, and that its remedies help."""
import math
import random
import re
import unittest

from support import ROOT, CliTestCase

RATE = 8000
TURN = 2 * math.pi
SAMPLES = 24000

ONE_CHANNEL = ROOT / "designs" / "models" / "type-2-pll.toml"

QUADRATURE = """
name = "test"
tracker = "quadrature-ekf"
[design]
q1 = 1e-6
q2 = 1e-8
r = 1e-4
epsilon = 0
[assume]
sample_rate = 8000
frequency = { hz = [300, 1200] }
noise = %s
slew = 1e-6
initial_frequency_error = 0.01
initial_phase_error = 0.01
initial_amplitude_error = 0.01
"""
BOUNDED = QUADRATURE % "0.06"
GAUSSIAN = QUADRATURE % "{ snr_db = 30 }\nsamples = 1e6"
GAUSSIAN = GAUSSIAN.replace("slew = 1e-6\n", "frequency_walk = 1e-5\n")


def steady(_):
    return 440.0


def one(_):
    return 1.0


def recording(samples=SAMPLES, hertz=steady, amplitude=one, added=None, distorted=None, noise=0.005, channels=2, seed=1):
    """CSV of a tone: `added` to both channels from sample and phase, `distorted` behind the noise."""
    generator = random.Random(seed)
    lines = ["t,i,q" if channels > 1 else "t,y"]
    phase = 0.3
    for k in range(samples):
        more = added(k, phase) if added else 0.0
        values = [amplitude(k) * math.cos(phase) + more + generator.gauss(0, noise),
                  amplitude(k) * math.sin(phase) + more + generator.gauss(0, noise)]
        if distorted:
            values = distorted(k, values)
        lines.append(",".join([f"{k / RATE:.6f}"] + [f"{value:.7g}" for value in values[:channels]]))
        phase += TURN * hertz(k) / RATE
    return "\n".join(lines) + "\n"


def clipped(level):
    return lambda k, values: [max(-level, min(level, value)) for value in values]


# name, how it is made, and what is found in it
TEN = [
    ("tone", {}, None),
    ("harmonic", {"added": lambda k, phase: 0.05 * math.cos(3 * phase + 0.5)}, "harmonics"),
    ("dc", {"added": lambda k, phase: 0.15}, "DC offset"),
    ("clipped", {"distorted": clipped(0.9)}, "clipping"),
    ("dropout", {"distorted": lambda k, values: [0.0, 0.0] if 12000 <= k < 12040 else values}, "dropouts"),
    ("gaps", {"distorted": lambda k, values: [math.nan, math.nan] if 12000 <= k < 12040 else values}, "gaps"),
    ("hum", {"added": lambda k, phase: 0.05 * math.cos(TURN * 50 * k / RATE)}, "hum"),
    ("drift", {"amplitude": lambda k: 1 - 0.1 * k / SAMPLES}, "amplitude drift"),
    ("sweep", {"hertz": lambda k: 440 + 300 * min(1.0, max(0.0, (k - 8000) / 8000))}, "fast sweep"),
    ("quantised", {"distorted": lambda k, values: [round(value * 16) / 16 for value in values]}, "quantisation"),
]


class TrackDefects(CliTestCase):
    def track(self, name, text, *options, design="design.toml"):
        self.write(text, name + ".csv")
        result = self.run_here("track", design, name + ".csv", *options)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result.stdout.split("track.md: ", 1)[1].rstrip("\n"), result.returncode

    def document(self, name):
        return (self.folder / "tracks-out" / name / "track.md").read_text()

    def test_ten_recordings(self):
        self.write(BOUNDED, "design.toml")
        for name, how, found in TEN:
            with self.subTest(name):
                sentence, status = self.track(name, recording(**how), "--strict")
                self.assertRegex(sentence, r"^(Kept|Lost) lock.*; the estimate is 0\.\d+ rad/sample \([\d.]+ Hz\) on average\. ")
                text = self.document(name)
                if found is None:
                    self.assertNotIn("Seen in the recording", sentence)
                    self.assertIn("Tested and kept, as far as estimates tell: signal, amplitude, frequency, slew, noise, samples. "
                                  "Not testable here: noise, outside of the samples judged, start.", sentence)
                    self.assertEqual(status, 0)
                else:
                    self.assertIn(f"Seen in the recording: {found}. ", sentence)
                    self.assertRegex(text, rf"\| {found} \| samples? \d+")

    def test_the_remedies_that_are_keys(self):
        self.write(BOUNDED, "design.toml")
        model = ONE_CHANNEL.read_text()
        for name, how, old, new in (
                ("harmonic", {"added": lambda k, phase: 0.05 * math.cos(3 * phase + 0.5)}, None, r"`(signal = '[^`]*')`"),
                ("dc", {"added": lambda k, phase: 0.15}, None, r"`(signal = '[^`]*')`"),
                ("drift", {"amplitude": lambda k: 1 - 0.1 * k / SAMPLES}, "amplitude = 1\n", r"`(amplitude = [^`]*)`")):
            with self.subTest(name):
                text = recording(channels=1, **how)
                before, _ = self.track(name, text, design=ONE_CHANNEL)
                self.assertIn("Seen in the recording", before)
                key = re.search(new, self.document(name)).group(1)
                self.write(model.replace("amplitude = 1\n", key + "\n" if old else "amplitude = 1\n" + key + "\n"),
                           "mended.toml")
                after, _ = self.track(name, text, design="mended.toml")
                self.assertNotIn("Seen in the recording", after)

    def test_the_remedies_that_are_options_and_samples(self):
        self.write(BOUNDED, "design.toml")
        silent = recording(distorted=lambda k, values: [0.0, 0.0] if k < 4000 else values)
        before, _ = self.track("silence", silent)
        self.assertIn("Seen in the recording: silence.", before)
        after, status = self.track("silence", silent, "--from", "4000", "--strict")
        self.assertNotIn("Seen in the recording", after)
        self.assertEqual(status, 0)
        sweep = recording(hertz=lambda k: 440 + 300 * min(1.0, max(0.0, (k - 8000) / 8000)))
        self.write(BOUNDED.replace("slew = 1e-6", "slew = 4e-5"), "design.toml")
        after, _ = self.track("sweep", sweep)
        self.assertNotIn("Seen in the recording", after)

    def test_after_a_hilbert_filter_a_gaussian_certificate_does_not_apply(self):
        self.write(GAUSSIAN, "design.toml")
        sentence, status = self.track("mono", recording(channels=1), "--strict")
        self.assertTrue(sentence.startswith(
            "The Gaussian certificate does not apply: after the Hilbert filter, noise is neither independent from sample to "
            "sample nor from channel to channel. Kept lock"), sentence)
        self.assertEqual(status, 1)
        text = self.document("mono")
        self.assertIn("| independent noise | from sample to sample |  | **not kept** |", text)
        sentence, status = self.track("stereo", recording(), "--strict")
        self.assertTrue(sentence.startswith("Kept lock"), sentence)
        self.assertIn("| independent noise | from channel to channel |  | not testable here |", self.document("stereo"))
        self.assertEqual(status, 0)

    def test_a_note_whose_second_harmonic_is_stronger(self):
        note = 'A*cos(phi) + 2.2*A*cos(2*phi + 1.2)'
        text = recording(channels=1, samples=12000, hertz=lambda k: 400,
                         added=lambda k, phase: 2.2 * math.cos(2 * phase + 1.2))
        model = ONE_CHANNEL.read_text().replace("e      = -2*y*sin(theta + w)", "e      = -0.4*y*sin(theta + w)")
        self.write(model.replace("amplitude = 1\n", f"amplitude = 1\nsignal = '{note}'\n"), "design.toml")
        sentence, _ = self.track("note", text)
        self.assertIn("Kept lock", sentence)
        self.assertRegex(sentence, r"\((400|399\.\d+|400\.\d+) Hz\) on average")

    def test_a_slow_tone_whose_period_is_longer_than_two_thousand_samples(self):
        period = 5000
        self.write(ONE_CHANNEL.read_text().replace("frequency = [0.2, 0.5]", "frequency = [0.001, 0.5]")
                   .replace("wn = 0.02", "wn = 0.00005"), "design.toml")
        text = recording(channels=1, samples=60000, hertz=lambda k: RATE / period)
        self.track("slow", text)
        self.assertIn("frequency 0.00125", self.document("slow"))

    def test_the_bias_of_the_tracker_stands_beside_the_fitted_frequency(self):
        def square(k, phase):
            return (1 if math.cos(phase) >= 0 else -1) * math.pi / 4 - math.cos(phase)
        text = recording(channels=1, added=square, noise=1e-4)
        sentence, _ = self.track("square", text, design=ROOT / "designs/la-scala-1994-figure-3.5-without-leak.toml")
        self.assertRegex(sentence, r"The estimate is 0\.\d+ rad/sample \([\d.]+ Hz\) above the frequency of the tone fitted to the "
                                   r"recording, 0\.345\d+ rad/sample \((440|439\.9\d+|440\.0\d+) Hz\): a bias of the tracker on "
                                   r"this recording \(harmonics\)")


if __name__ == "__main__":
    unittest.main()
