
(* Everything above is the same for all designs of the kind. *)

(* The design: rates in 1/s, s = x3 = omega^2 in (rad/s)^2. *)
Definition l1 : R := 1.
Definition l2 : R := 2.
Definition l3 : R := 3.
Definition l4 : R := 4.
Definition in_range (s : R) : Prop := (5 / 10) ^ 2 <= s <= 4 ^ 2.
Definition ell_lower : R := (691009523 / 1000000000000).
Definition ell_in_use : R := (3186718959817135 / 2 ^ 62).
Ltac unfold_design := unfold in_range, ell_lower, ell_in_use, l1, l2, l3, l4 in *.
Lemma range_is_positive : forall s : R, in_range s -> 0 < s.
Proof. intros s range. unfold_design. nra. Qed.
Lemma rates_differ : l1 <> l2.
Proof. unfold_design. lra. Qed.

Lemma first_entry_is_positive : forall s : R, in_range s ->
  0 < entry_a l1 l2 l3 l4 ell_lower s.
Proof.
intros s range. unfold_form. unfold_design.
interval with (i_bisect s, i_autodiff s, i_prec 90).
Qed.

Lemma discriminant_is_positive : forall s : R, in_range s ->
  0 < entry_a l1 l2 l3 l4 ell_lower s * entry_c l1 l2 l3 l4 ell_lower s - entry_b l1 l2 l3 l4 ell_lower s ^ 2.
Proof.
intros s range. unfold_form. unfold_design.
interval with (i_bisect s, i_autodiff s, i_prec 90).
Qed.

Lemma ell_is_at_least :
  forall x1 x2 s : R, in_range s ->
  let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  ell_lower * g33 u1 u2 u3 u4 <= excitation l1 l2 l3 l4 u1 u2 u3 u4.
Proof.
intros x1 x2 s range. apply excitation_is_at_least; [ apply range_is_positive | apply first_entry_is_positive |
  apply discriminant_is_positive ]; assumption.
Qed.

Definition ell_upper : R := (691009525 / 1000000000000).

Lemma ell_is_at_most :
  exists x1 x2 s : R, in_range s /\ (x1 <> 0 \/ x2 <> 0) /\
  (let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  excitation l1 l2 l3 l4 u1 u2 u3 u4 <= ell_upper * g33 u1 u2 u3 u4).
Proof.
exists (- (1207444726629133 / 2 ^ 56)), (- (6073908518308717 / 2 ^ 49)), (4 ^ 2). split; [ | split ].
- unfold_design. lra.
- left; lra.
- cbv zeta. unfold g33, excitation, transform, ell_upper. unfold_design. interval with (i_prec 90).
Qed.

Lemma gamma_inverts_T :
  forall x1 x2 s y1 y2 y3 : R, in_range s -> x1 <> 0 \/ x2 <> 0 ->
  let u1 := transform l1 x1 x2 s in let u2 := transform l2 x1 x2 s in
  let u3 := transform l3 x1 x2 s in let u4 := transform l4 x1 x2 s in
  solves (regularization ell_in_use l1 l2 l3 l4 u1 u2 u3 u4) l1 l2 l3 l4 u1 u2 u3 u4 y1 y2 y3 ->
  y1 = x1 /\ y2 = x2 /\ y3 = s.
Proof.
intros x1 x2 s y1 y2 y3 range nonzero. apply (inverse_where_excited ell_lower).
- apply range_is_positive; assumption.
- apply rates_differ.
- assumption.
- unfold_design; lra.
- unfold_design; lra.
- apply ell_is_at_least; assumption.
Qed.

(* The statements that certificate.md lists as proved here, and their axioms. *)
Definition proved_here := (
  invariance,
  determinant,
  inverse_where_regularization_vanishes,
  ell_is_at_least,
  ell_is_at_most,
  gamma_inverts_T).
Print Assumptions proved_here.
