From Coq Require Export Reals Lra Psatz.
From Interval Require Export Tactic Specific_ops Specific_stdz.

(* The interval tactic on Coq's own integers: it needs no axiom beyond those of the real numbers. *)
Module IntegerFloats := SpecificFloat StdZRadix2.
Module IntegerIntervals := IntervalTactic IntegerFloats.
Export IntegerIntervals.
Open Scope R_scope.

(* The constants of Theorem 2.9 of B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis,
   Australian National University, 1994, as they are written there (sections 2.4 and 3.5), and with its errata sheet;
   delta_1 = a_2 = q1, delta_2 = r, a_1 = q2, rho_3 = rho_4 = rho_2, rho_5 = 1. *)
Inductive reading := printed | errata.

(* The design at unit amplitude, and the free parameters of the theorem; state_bound is R_x. *)
Record design := {
  q1 : R; q2 : R; r : R; state_bound : R; sigma : R; gamma_fraction : R; c1 : R; c2 : R }.

Section Constants.
Variable v : reading.
Variable d : design.
Definition epsilon_r : R := match v with printed => 1 / sqrt 2 - sigma d | errata => 1 - sigma d end.
Definition b_1 : R := match v with
  | printed => / (2 * r d) * (1 - sqrt 2 * epsilon_r) ^ 2 * (1 - / 4 * (1 - sqrt 2 * epsilon_r) ^ 2)
  | errata => sigma d / (2 * r d) end.
Definition b_2 : R := match v with
  | printed => 3 / r d * (1 + sqrt 2 * epsilon_r) ^ 2 | errata => 5 / r d end.
Definition rho_1 : R := 2 * (state_bound d + epsilon_r).
Definition rho_2 : R := sqrt 2 * (state_bound d + epsilon_r).
Definition p : R := q2 d + 1 / b_1.
Definition q : R := 1 / q1 d + b_2.
Definition s : R := q + rho_1 ^ 2 / q1 d.
Definition gamma : R := gamma_fraction d / (s * p ^ 2).
Definition beta : R := sqrt (p * q).
Definition alpha : R := sqrt (1 - gamma / q).
Definition one_minus_alpha : R := 1 - alpha.
(* (2.35) *)
Definition bracket : R := - rho_1 + sqrt (rho_1 ^ 2 + / q * (1 / (s * p ^ 2) - gamma)).
Definition epsilon_z_2 : R := sqrt 2 / sqrt rho_2 * sqrt bracket.
Definition epsilon_z : R := Rmin epsilon_r epsilon_z_2.
Definition delta_p : R := 2 * rho_1 * rho_2 * p.
Definition delta_k : R := delta_p / r d * (1 + s / r d).
Definition delta_k2 : R :=
  2 * p * (rho_2 * rho_1 + rho_2 ^ 2) / r d + 2 * delta_p ^ 2 / r d ^ 2 +
  s * (2 * delta_p ^ 2 / r d ^ 3 + 2 * p * (rho_2 * rho_1 + rho_2 ^ 2) / r d ^ 2).
(* (2.39) *)
Definition zeta_z : R := delta_k * rho_1 * epsilon_z.
Definition w_bound : R := c1 d * sqrt (q2 d).
Definition v_bound : R := c2 d * sqrt (r d).
(* The entries of (2.40). *)
Definition eta_size : R := p * q * (w_bound + / 2 * rho_2 * epsilon_r ^ 2) + p / r d * v_bound.
Definition eta_slope : R := delta_k * (w_bound + v_bound + / 2 * rho_2 * epsilon_r ^ 2) + 2 * p * q * rho_1.
Definition eta : R := Rmax eta_size eta_slope.
(* (2.42) *)
Definition zeta : R := 2 * rho_1 * delta_k + rho_1 * delta_k2 * epsilon_r.
Definition lhs_2_43 : R := beta * (zeta + eta) + alpha.
Definition lhs_2_44 : R := beta * zeta_z + alpha.
Definition initial_error_bound : R := epsilon_z / beta.
End Constants.

(* Evaluates a statement about the constants of one design. *)
Ltac expand design :=
  cbv [ design lhs_2_43 lhs_2_44 initial_error_bound zeta eta eta_size eta_slope zeta_z w_bound v_bound delta_k2
    delta_k delta_p epsilon_z epsilon_z_2 bracket one_minus_alpha alpha beta gamma s q p rho_1 rho_2 b_1 b_2 epsilon_r
    q1 q2 r state_bound sigma gamma_fraction c1 c2 ].
Ltac choose :=
  match goal with
  | |- context [ Rmin ?a ?b ] =>
    first [ rewrite (Rmin_right a b) by interval with (i_prec 180)
          | rewrite (Rmin_left a b) by interval with (i_prec 180) ]
  | |- context [ Rmax ?a ?b ] =>
    first [ rewrite (Rmax_right a b) by interval with (i_prec 180)
          | rewrite (Rmax_left a b) by interval with (i_prec 180) ]
  end.
Ltac evaluate design := expand design; repeat choose; first [ interval with (i_prec 100) | interval with (i_prec 180) ].


(* What the theorem admits. *)
Definition admissible (v : reading) (d : design) : Prop :=
  0 < q1 d /\ 0 < q2 d /\ 0 < r d /\ 1 <= state_bound d /\ 0 <= c1 d /\ 0 <= c2 d /\
  0 < sigma d < match v with printed => 1 / sqrt 2 | errata => 1 end.

Lemma epsilon_r_is_positive : forall v d, admissible v d -> 0 < epsilon_r v d.
Proof. intros v d (_ & _ & _ & _ & _ & _ & range). unfold epsilon_r. destruct v; lra. Qed.

Lemma ratio_of_gramian_bounds : forall v d, admissible v d -> 0 < b_1 v d /\ 8 * b_1 v d <= b_2 v d.
Proof.
intros v d (_ & _ & r_is_positive & _ & _ & _ & range).
assert (0 < / r d) by (apply Rinv_0_lt_compat; assumption).
unfold b_1, b_2, epsilon_r. destruct v.
- assert (root : 0 < sqrt 2) by (apply sqrt_lt_R0; lra).
  replace (1 - sqrt 2 * (1 / sqrt 2 - sigma d)) with (sqrt 2 * sigma d) by (field; lra).
  replace (1 + sqrt 2 * (1 / sqrt 2 - sigma d)) with (2 - sqrt 2 * sigma d) by (field; lra).
  assert (below_1 : sqrt 2 * sigma d < 1).
  { replace 1 with (sqrt 2 * (1 / sqrt 2)) by (field; lra). apply Rmult_lt_compat_l; lra. }
  assert (above_0 : 0 < sqrt 2 * sigma d) by (apply Rmult_lt_0_compat; lra).
  revert below_1 above_0. generalize (sqrt 2 * sigma d). intros t below_1 above_0.
  replace (/ (2 * r d)) with (/ r d * / 2) by (field; lra).
  assert (square : 0 < t ^ 2 < 1) by nra.
  split.
  + apply Rmult_lt_0_compat; [ apply Rmult_lt_0_compat | ]; lra.
  + assert (4 * (t ^ 2 * (1 - / 4 * t ^ 2)) <= 3 * (2 - t) ^ 2) by nra.
    replace (8 * (/ r d * / 2 * t ^ 2 * (1 - / 4 * t ^ 2))) with (/ r d * (4 * (t ^ 2 * (1 - / 4 * t ^ 2)))) by (field; lra).
    replace (3 / r d * (2 - t) ^ 2) with (/ r d * (3 * (2 - t) ^ 2)) by (field; lra).
    apply Rmult_le_compat_l; lra.
- replace (sigma d / (2 * r d)) with (/ r d * (sigma d / 2)) by (field; lra).
  unfold Rdiv. split; [ apply Rmult_lt_0_compat; lra | ].
  replace (8 * (/ r d * (sigma d * / 2))) with (/ r d * (4 * sigma d)) by (field; lra).
  rewrite (Rmult_comm 5). apply Rmult_le_compat_l; lra.
Qed.

Ltac non_negative := repeat first
  [ assumption | lra | apply Rplus_le_le_0_compat | apply Rmult_le_pos | apply pow_le | apply sqrt_pos
  | apply Rlt_le; apply Rinv_0_lt_compat; first [ assumption | apply pow_lt; assumption ] ].

(* No choice of the free parameters, for no design, satisfies (2.43): its left side is 90 R_x at least. *)
Theorem condition_2_43_fails_for_every_design : forall v d, admissible v d ->
  4 * (8 * sqrt 8) * state_bound d <= lhs_2_43 v d /\ 1 < lhs_2_43 v d.
Proof.
intros v d allowed.
destruct (ratio_of_gramian_bounds v d allowed) as (b_1_is_positive & ratio).
assert (e := epsilon_r_is_positive v d allowed).
destruct allowed as (q1_is_positive & q2_is_positive & r_is_positive & bound & c1_is_not_negative & c2_is_not_negative & _).
assert (0 < / b_1 v d) by (apply Rinv_0_lt_compat; assumption).
assert (0 < / q1 d) by (apply Rinv_0_lt_compat; assumption).
assert (p_least : / b_1 v d <= p v d) by (unfold p; lra).
assert (q_least : b_2 v d <= q v d) by (unfold q; lra).
assert (product : 8 <= p v d * q v d).
{ apply Rle_trans with (/ b_1 v d * (8 * b_1 v d)); [ right; field; lra | ].
  apply Rmult_le_compat; lra. }
assert (0 <= p v d) by lra.
assert (0 <= q v d) by lra.
assert (rho : 2 * state_bound d <= rho_1 v d) by (unfold rho_1; lra).
assert (0 <= rho_1 v d) by lra.
assert (0 <= rho_2 v d) by (unfold rho_2; non_negative).
assert (0 <= epsilon_r v d) by lra.
assert (0 <= s v d) by (unfold s, Rdiv; non_negative).
assert (0 <= delta_p v d) by (unfold delta_p; non_negative).
assert (0 <= delta_k v d) by (unfold delta_k, Rdiv; non_negative).
assert (0 <= delta_k2 v d) by (unfold delta_k2, Rdiv; non_negative).
assert (0 <= zeta v d) by (unfold zeta; non_negative).
assert (0 <= w_bound d) by (unfold w_bound; non_negative).
assert (0 <= v_bound d) by (unfold v_bound; non_negative).
assert (slope : 2 * 8 * (2 * state_bound d) <= eta_slope v d).
{ unfold eta_slope.
  assert (0 <= delta_k v d * (w_bound d + v_bound d + / 2 * rho_2 v d * epsilon_r v d ^ 2)) by non_negative.
  assert (8 * (2 * state_bound d) <= p v d * q v d * rho_1 v d) by (apply Rmult_le_compat; lra).
  lra. }
assert (larger : eta_slope v d <= eta v d) by apply Rmax_r.
assert (root : sqrt 8 <= beta v d) by (apply sqrt_le_1_alt; assumption).
assert (0 <= alpha v d) by apply sqrt_pos.
assert (0 <= sqrt 8) by apply sqrt_pos.
assert (least : sqrt 8 * (2 * 8 * (2 * state_bound d)) <= beta v d * (zeta v d + eta v d))
  by (apply Rmult_le_compat; lra).
assert (1 < sqrt 8) by interval with (i_prec 60).
unfold lhs_2_43. split; nra.
Qed.
