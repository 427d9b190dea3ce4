From Coq Require Import Reals Lra Psatz.
From Veritrack Require Import filter frame error.
Local Open Scope R_scope.

(* The covariance is monotone in its order: Phi is the least of (I - K H) Phat (I - K H)' + r K K' over all gains K, and
   equals it at the filter's own. *)
Definition innovation_form (d : noise_model) (p : symmetric) (a b : R) : R :=
  (s11 p + r d) * a * a + 2 * s12 p * a * b + (s22 p + r d) * b * b.

Lemma corrected_form : forall d p a b z k1 k2, det_S d p <> 0 ->
  form p (a - k1) (b - k2) z + r d * (k1 * k1 + k2 * k2) =
  form (corrected d p) a b z + innovation_form d p
    (k1 - (gain_1 d p (s11 p) (s12 p) * a + gain_1 d p (s12 p) (s22 p) * b + gain_1 d p (s13 p) (s23 p) * z))
    (k2 - (gain_2 d p (s11 p) (s12 p) * a + gain_2 d p (s12 p) (s22 p) * b + gain_2 d p (s13 p) (s23 p) * z)).
Proof.
  intros d p a b z k1 k2 D; unfold innovation_form, form, corrected, gain_1, gain_2; cbn [s11 s12 s13 s22 s23 s33].
  unfold det_S in *; field; exact D.
Qed.

Lemma predicted_form : forall d z1 z2 p a b z,
  form (predicted d z1 z2 p) a b z = form p a b (z - z2 * a + z1 * b) + q1 d * (a * a + b * b) + q2 d * (z * z).
Proof. intros; unfold form, predicted; cbn [s11 s12 s13 s22 s23 s33]; ring. Qed.

Definition not_negative (m : symmetric) : Prop := forall a b c, 0 <= form m a b c.

Section Order.
Variable d : noise_model.
Hypothesis q1_not_negative : 0 <= q1 d.
Hypothesis q2_not_negative : 0 <= q2 d.
Hypothesis r_positive : 0 < r d.

Lemma predicted_not_negative : forall z1 z2 p, not_negative p -> not_negative (predicted d z1 z2 p).
Proof.
  intros z1 z2 p P a b z; rewrite predicted_form; pose proof (P a b (z - z2 * a + z1 * b)); nra.
Qed.

Lemma innovation_form_not_negative : forall p a b, not_negative p -> 0 <= innovation_form d p a b.
Proof. intros p a b P; pose proof (P a b 0) as Z; unfold form, innovation_form in *; nra. Qed.

Lemma det_S_positive : forall p, not_negative p -> 0 < det_S d p.
Proof.
  intros p P; pose proof (P 1 0 0) as A; pose proof (P (- s12 p) (s11 p + r d) 0) as B; unfold form in A, B; unfold det_S.
  assert (0 < s11 p + r d) by lra.
  assert (0 < (s11 p + r d) * ((s11 p + r d) * (s22 p + r d) - s12 p * s12 p)).
  { pose proof (Rmult_lt_0_compat _ _ H H) as square; pose proof (Rle_0_sqr (s12 p)); unfold Rsqr in *.
    pose proof (Rmult_lt_0_compat _ _ r_positive square).
    pose proof (Rmult_le_pos _ _ (Rlt_le _ _ r_positive) H0). nra. }
  nra.
Qed.

Lemma predicted_below : forall z1 z2 p p', below p p' -> below (predicted d z1 z2 p) (predicted d z1 z2 p').
Proof.
  intros z1 z2 p p' B a b z; rewrite !predicted_form; pose proof (B a b (z - z2 * a + z1 * b)); lra.
Qed.

(* An upper bound on the covariance after the step, from any gain (k1 = k11 a + k21 b + k31 z, ...). *)
Lemma corrected_upper : forall p p' top k11 k12 k21 k22 k31 k32, not_negative p -> below p p' ->
  (forall a b z, let k1 := k11 * a + k21 * b + k31 * z in let k2 := k12 * a + k22 * b + k32 * z in
     form p' (a - k1) (b - k2) z + r d * (k1 * k1 + k2 * k2) <= form top a b z) ->
  below (corrected d p) top.
Proof.
  intros p p' top k11 k12 k21 k22 k31 k32 P B bound a b z.
  eapply Rle_trans; [| apply bound]; cbv zeta.
  set (k1 := k11 * a + _ + _); set (k2 := k12 * a + _ + _).
  pose proof (corrected_form d p a b z k1 k2 (Rgt_not_eq _ _ (det_S_positive p P))) as E.
  match type of E with _ = _ + innovation_form _ _ ?u ?w => pose proof (innovation_form_not_negative p u w P) end.
  pose proof (B (a - k1) (b - k2) z); lra.
Qed.

(* A lower bound, from all gains at once. *)
Lemma corrected_lower : forall p p' bottom, not_negative p -> below p' p ->
  (forall a b z k1 k2, form bottom a b z <= form p' (a - k1) (b - k2) z + r d * (k1 * k1 + k2 * k2)) ->
  below bottom (corrected d p).
Proof.
  intros p p' bottom P B bound a b z.
  set (k1 := gain_1 d p (s11 p) (s12 p) * a + gain_1 d p (s12 p) (s22 p) * b + gain_1 d p (s13 p) (s23 p) * z).
  set (k2 := gain_2 d p (s11 p) (s12 p) * a + gain_2 d p (s12 p) (s22 p) * b + gain_2 d p (s13 p) (s23 p) * z).
  pose proof (corrected_form d p a b z k1 k2 (Rgt_not_eq _ _ (det_S_positive p P))) as E.
  fold k1 k2 in E.
  replace (innovation_form d p (k1 - k1) (k2 - k2)) with 0 in E by (unfold innovation_form; ring).
  pose proof (bound a b z k1 k2); pose proof (B (a - k1) (b - k2) z); lra.
Qed.
End Order.

(* The middle of two matrices and half their difference, and how far a matrix between them is from the middle: for every
   u and h, 2 u' (m - middle) H' h / r <= lambda u' half u + mu h' H half H' h. *)
Definition middle (l u : symmetric) : symmetric :=
  Symmetric ((s11 l + s11 u) / 2) ((s12 l + s12 u) / 2) ((s13 l + s13 u) / 2) ((s22 l + s22 u) / 2)
            ((s23 l + s23 u) / 2) ((s33 l + s33 u) / 2).
Definition half (l u : symmetric) : symmetric :=
  Symmetric ((s11 u - s11 l) / 2) ((s12 u - s12 l) / 2) ((s13 u - s13 l) / 2) ((s22 u - s22 l) / 2)
            ((s23 u - s23 l) / 2) ((s33 u - s33 l) / 2).
Definition pairing (m : symmetric) (b1 b2 b3 h1 h2 : R) : R :=
  b1 * (s11 m * h1 + s12 m * h2) + b2 * (s12 m * h1 + s22 m * h2) + b3 * (s13 m * h1 + s23 m * h2).

Lemma young : forall l u m lambda mu rho b1 b2 b3 h1 h2, below l m -> below m u -> below l u ->
  0 < lambda -> 0 < rho -> 1 <= lambda * mu * (rho * rho) ->
  2 * (pairing m b1 b2 b3 h1 h2 / rho) <=
  2 * (pairing (middle l u) b1 b2 b3 h1 h2 / rho) + lambda * form (half l u) b1 b2 b3 + mu * form (half l u) h1 h2 0.
Proof.
  intros l u m lambda mu rho b1 b2 b3 h1 h2 L U LU lambda0 rho0 large.
  set (t := / (lambda * rho)).
  assert (t0 : t * (lambda * rho) = 1) by (apply Rinv_l, Rgt_not_eq, Rmult_lt_0_compat; assumption).
  pose proof (U (b1 + t * h1) (b2 + t * h2) b3) as A; pose proof (L (b1 - t * h1) (b2 - t * h2) b3) as B.
  assert (C : 4 * t * pairing m b1 b2 b3 h1 h2 <= 4 * t * pairing (middle l u) b1 b2 b3 h1 h2 +
    2 * form (half l u) b1 b2 b3 + 2 * (t * t) * form (half l u) h1 h2 0).
  { unfold form, pairing, middle, half in *; cbn [s11 s12 s13 s22 s23 s33] in *. lra. }
  assert (0 <= form (half l u) h1 h2 0).
  { pose proof (LU h1 h2 0) as Z; unfold form, half in *; cbn [s11 s12 s13 s22 s23 s33] in *; lra. }
  assert (lambda * (t * t) <= mu).
  { apply (Rmult_le_reg_l (lambda * (rho * rho))); [repeat apply Rmult_lt_0_compat; assumption |].
    replace (lambda * (rho * rho) * (lambda * (t * t))) with ((t * (lambda * rho)) * (t * (lambda * rho))) by ring.
    rewrite t0; lra. }
  assert (same : forall k, 2 * (k / rho) = lambda / 2 * (4 * t * k)) by (intro; unfold t; field; split; apply Rgt_not_eq; assumption).
  rewrite !same.
  apply (Rmult_le_compat_l (lambda / 2)) in C; [| lra]. nra.
Qed.
