
(* Everything above is the same for all designs of the kind. *)

(* The gain and the frequency at which the design's filter is frozen. *)
Definition gain_1 : R := (435768406828685 / 2 ^ 49).
Definition gain_2 : R := (- (2836283650223665 / 2 ^ 55)).
Definition zero_angle : R := (3 / 2 ^ 1).

Lemma poles :
  forall a b : R,
  let t := gain_2 * sin zero_angle + (2 - gain_1) * cos zero_angle in
  a ^ 2 - b ^ 2 - t * a + (1 - gain_1) = 0 -> 2 * a * b - t * b = 0 -> a ^ 2 + b ^ 2 < 1.
Proof.
intros a b t. apply jury; unfold t, gain_1, gain_2, zero_angle;
  repeat split; interval with (i_prec 100).
Qed.

(* The statements that certificate.md lists as proved here, and their axioms. *)
Definition proved_here := (
  characteristic_polynomial,
  denominator_as_printed_is_another,
  numerator_1,
  numerator_2,
  response,
  response_as_printed_is_another,
  zeros,
  poles).
Print Assumptions proved_here.
