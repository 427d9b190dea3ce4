From Coq Require Import Reals Lra Psatz.
From Veritrack Require Import filter frame error order.
Local Open Scope R_scope.

(* What a certified set says about one step: from the errors (e1, e2, nu) and every covariance between p_lo and p_hi the
   step ends between p_lo and p_hi again, and the level e' M e falls by the factor kappa2 but for noise and slew. *)
Record ellipsoid := {
  M : symmetric; p_lo : symmetric; p_hi : symmetric; kappa2 : R; noise_gain : R; slew_gain : R }.

Definition next_error (d : noise_model) (m : symmetric) (h1 h2 nu c s u1 u2 w : R) : R * R * R :=
  let i1 := u1 - h1 in let i2 := u2 - h2 in
  let a1 := h1 + (s11 m * i1 + s12 m * i2) / r d in
  let a2 := h2 + (s12 m * i1 + s22 m * i2) / r d in
  let a3 := nu + (s13 m * i1 + s23 m * i2) / r d in
  (c * a1 - s * a2, s * a1 + c * a2, a3 - w).
Definition level (m : symmetric) (e : R * R * R) : R := let '(e1, e2, nu) := e in form m e1 e2 nu.

Definition step_is_kept (d : noise_model) (o : ellipsoid) (e1 e2 nu : R) : Prop :=
  forall p, below (p_lo o) p -> below p (p_hi o) ->
  det_S d (predicted d (1 + e1) e2 p) <> 0 /\
  let m := next d e1 e2 p in
  below (p_lo o) (turned (cos nu) (sin nu) m) /\ below (turned (cos nu) (sin nu) m) (p_hi o) /\
  forall u1 u2 w,
    level (M o) (next_error d m (1 + e1 - cos nu) (e2 + sin nu) nu (cos nu) (sin nu) u1 u2 w) <=
    kappa2 o * form (M o) e1 e2 nu + noise_gain o * (u1 * u1 + u2 * u2) + slew_gain o * (w * w).

Section For_ever.
Variable d : noise_model.
Variable o : ellipsoid.
Variables V W ultimate : R.
Hypothesis r_positive : 0 < r d.
Hypothesis kept : forall e1 e2 nu, form (M o) e1 e2 nu <= 1 -> step_is_kept d o e1 e2 nu.
Hypothesis kappa_range : 0 <= kappa2 o < 1.
Hypothesis gains_not_negative : 0 <= noise_gain o /\ 0 <= slew_gain o.
Hypothesis ultimate_range : 0 <= ultimate <= 1.
Hypothesis disturbed : noise_gain o * (V * V) + slew_gain o * (W * W) <= (1 - kappa2 o) * ultimate.

Variables phi omega v1 v2 : nat -> R.
Hypothesis tone : forall k, phi (S k) = phi k + omega k.
Hypothesis noise : forall k, v1 k * v1 k + v2 k * v2 k <= V * V.
Hypothesis slew : forall k, (omega (S k) - omega k) * (omega (S k) - omega k) <= W * W.

Definition is_inside (s : estimate) (phi omega bound : R) : Prop := exists e1 e2 nu p,
  has_errors s phi omega e1 e2 nu p /\ below (p_lo o) p /\ below p (p_hi o) /\ form (M o) e1 e2 nu <= bound.

Definition bound_at (k : nat) : R := kappa2 o ^ k * (1 - ultimate) + ultimate.

Lemma bound_at_most_1 : forall k, bound_at k <= 1.
Proof.
  intro k; unfold bound_at; assert (0 <= kappa2 o ^ k <= 1).
  { split; [apply pow_le; lra |]; induction k; simpl; [lra | nra]. }
  nra.
Qed.

Theorem inside_for_ever : forall start, is_inside start (phi 0%nat) (omega 0%nat) 1 ->
  forall k, is_inside (run d start (measurement phi v1 v2) k) (phi k) (omega k) (bound_at k).
Proof.
  intros start inside k; induction k as [| k IH].
  - destruct inside as (e1 & e2 & nu & p & A & B & C & D); exists e1, e2, nu, p; unfold bound_at; simpl.
    repeat split; try assumption; try apply A; lra.
  - destruct IH as (e1 & e2 & nu & p & A & B & C & D).
    destruct (kept e1 e2 nu (Rle_trans _ _ _ D (bound_at_most_1 k)) p B C) as (det & lower & upper & error).
    destruct (step_errors d _ _ _ _ _ _ _ (v1 (S k)) (v2 (S k)) (omega (S k)) (Rgt_not_eq _ _ r_positive) det A)
      as (u1 & u2 & length & next).
    cbv zeta in next; rewrite <- tone in next.
    do 4 eexists; split; [exact next |]; split; [exact lower |]; split; [exact upper |].
    eapply Rle_trans; [exact (error u1 u2 (omega (S k) - omega k)) |].
    rewrite length; pose proof (noise (S k)) as n; pose proof (slew k) as w.
    destruct gains_not_negative as [g1 g2].
    pose proof (Rmult_le_compat_l _ _ _ g1 n); pose proof (Rmult_le_compat_l _ _ _ g2 w).
    pose proof (Rmult_le_compat_l _ _ _ (proj1 kappa_range) D) as shrunk.
    unfold bound_at in *; simpl; nra.
Qed.
End For_ever.
