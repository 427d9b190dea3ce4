From Coq Require Import Reals Lra Lia Psatz.
From Veritrack Require Import filter.
Local Open Scope R_scope.

(* One step in a frame that is turned by an angle with cosine c and sine s: the filter commutes with turns. *)
Definition seen (c s : R) (A : matrix 3 3) (m : symmetric) : Prop :=
  A 1%nat 1%nat = c * c * s11 m - 2 * c * s * s12 m + s * s * s22 m /\
  A 1%nat 2%nat = c * s * (s11 m - s22 m) + (c * c - s * s) * s12 m /\
  A 2%nat 1%nat = c * s * (s11 m - s22 m) + (c * c - s * s) * s12 m /\
  A 2%nat 2%nat = s * s * s11 m + 2 * c * s * s12 m + c * c * s22 m /\
  A 1%nat 3%nat = c * s13 m - s * s23 m /\ A 3%nat 1%nat = c * s13 m - s * s23 m /\
  A 2%nat 3%nat = s * s13 m + c * s23 m /\ A 3%nat 2%nat = s * s13 m + c * s23 m /\
  A 3%nat 3%nat = s33 m.

Definition at_angle (c s : R) (x : matrix 3 1) (z1 z2 frequency : R) : Prop :=
  x 1%nat 1%nat = c * z1 - s * z2 /\ x 2%nat 1%nat = s * z1 + c * z2 /\ x 3%nat 1%nat = frequency.

(* F P F' + Q with the estimate 1 + e1 + i e2 in the frame, F = [I, i (1 + e1 + i e2); 0, 1]. *)
Definition predicted (d : noise_model) (z1 z2 : R) (p : symmetric) : symmetric :=
  Symmetric (s11 p - 2 * z2 * s13 p + z2 * z2 * s33 p + q1 d) (s12 p - z2 * s23 p + z1 * s13 p - z1 * z2 * s33 p)
            (s13 p - z2 * s33 p) (s22 p + 2 * z1 * s23 p + z1 * z1 * s33 p + q1 d) (s23 p + z1 * s33 p) (s33 p + q2 d).

Definition det_S (d : noise_model) (p : symmetric) : R := (s11 p + r d) * (s22 p + r d) - s12 p * s12 p.
(* Row (a, b) of P H' times S^-1. *)
Definition gain_1 (d : noise_model) (p : symmetric) (a b : R) : R := (a * (s22 p + r d) - b * s12 p) / det_S d p.
Definition gain_2 (d : noise_model) (p : symmetric) (a b : R) : R := (b * (s11 p + r d) - a * s12 p) / det_S d p.
Definition corrected (d : noise_model) (p : symmetric) : symmetric :=
  let k11 := gain_1 d p (s11 p) (s12 p) in let k12 := gain_2 d p (s11 p) (s12 p) in
  let k21 := gain_1 d p (s12 p) (s22 p) in let k22 := gain_2 d p (s12 p) (s22 p) in
  let k31 := gain_1 d p (s13 p) (s23 p) in let k32 := gain_2 d p (s13 p) (s23 p) in
  Symmetric (s11 p - k11 * s11 p - k12 * s12 p) (s12 p - k11 * s12 p - k12 * s22 p) (s13 p - k11 * s13 p - k12 * s23 p)
            (s22 p - k21 * s12 p - k22 * s22 p) (s23 p - k21 * s13 p - k22 * s23 p) (s33 p - k31 * s13 p - k32 * s23 p).

Ltac unfold_matrices := cbv [P x time_update measurement_update f F Q_x R_y H gain times plus minus transpose matrix_3_3
  vector_3 vector_2 inverse_2_2 sum Nat.eqb full turn] in *.

Lemma seen_turn : forall a m, seen (cos a) (sin a) (turn a * full m * (turn a)^T)%matrix m.
Proof. intros a m; unfold seen; unfold_matrices; repeat split; ring. Qed.

Lemma time_update_seen : forall d s c n z1 z2 w p,
  c * c + n * n = 1 -> at_angle c n (x s) z1 z2 w -> seen c n (P s) p ->
  let c' := c * cos w - n * sin w in let n' := n * cos w + c * sin w in
  at_angle c' n' (x (time_update d s)) z1 z2 w /\ seen c' n' (P (time_update d s)) (predicted d z1 z2 p).
Proof.
  intros d [X A] c n z1 z2 w p unit (X1 & X2 & X3) (A11 & A12 & A21 & A22 & A13 & A31 & A23 & A32 & A33) c' n'.
  assert (turned : cos w * cos w = 1 - sin w * sin w) by (pose proof (sin2_cos2 w); unfold Rsqr in *; lra).
  assert (square : c * c = 1 - n * n) by lra.
  subst c' n'; unfold at_angle, seen, predicted; unfold_matrices; cbn [s11 s12 s13 s22 s23 s33] in *.
  rewrite X3, X1, X2, A11, A12, A21, A22, A13, A31, A23, A32, A33; clear - turned square.
  generalize dependent (cos w); generalize dependent (sin w); intros; repeat split; ring [turned square].
Qed.

Lemma gain_entries : forall d A i, (let D := (A 1%nat 1%nat + r d) * (A 2%nat 2%nat + r d) - A 1%nat 2%nat * A 2%nat 1%nat in
  gain d A i 1%nat = (A i 1%nat * (A 2%nat 2%nat + r d) - A i 2%nat * A 2%nat 1%nat) / D /\
  gain d A i 2%nat = (A i 2%nat * (A 1%nat 1%nat + r d) - A i 1%nat * A 1%nat 2%nat) / D).
Proof.
  intros d A i D; split; unfold_matrices; unfold Rdiv;
    match goal with |- context [/ ?e] => replace e with D by (unfold D; ring) end; ring.
Qed.

(* K = Phi H' / r, Phi the corrected covariance. *)
Lemma corrected_is_gain : forall d p, det_S d p <> 0 -> r d <> 0 ->
  s11 (corrected d p) = r d * gain_1 d p (s11 p) (s12 p) /\ s12 (corrected d p) = r d * gain_2 d p (s11 p) (s12 p) /\
  s12 (corrected d p) = r d * gain_1 d p (s12 p) (s22 p) /\ s22 (corrected d p) = r d * gain_2 d p (s12 p) (s22 p) /\
  s13 (corrected d p) = r d * gain_1 d p (s13 p) (s23 p) /\ s23 (corrected d p) = r d * gain_2 d p (s13 p) (s23 p).
Proof.
  intros d p D r0; unfold corrected, gain_1, gain_2; cbn [s11 s12 s13 s22 s23 s33]; unfold det_S in *.
  repeat split; field; exact D.
Qed.

Lemma turned_back : forall c n r1 r2 i1 i2, c * c + n * n = 1 ->
  (c * r1 - n * r2) * (c * i1 - n * i2) + (n * r1 + c * r2) * (n * i1 + c * i2) = r1 * i1 + r2 * i2.
Proof.
  intros c n r1 r2 i1 i2 unit; transitivity ((c * c + n * n) * (r1 * i1 + r2 * i2)); [ring | rewrite unit; ring].
Qed.

Lemma corrected_is_symmetric : forall d p, det_S d p <> 0 ->
  let k11 := gain_1 d p (s11 p) (s12 p) in let k12 := gain_2 d p (s11 p) (s12 p) in
  let k21 := gain_1 d p (s12 p) (s22 p) in let k22 := gain_2 d p (s12 p) (s22 p) in
  let k31 := gain_1 d p (s13 p) (s23 p) in let k32 := gain_2 d p (s13 p) (s23 p) in
  k21 * s11 p + k22 * s12 p = k11 * s12 p + k12 * s22 p /\
  k31 * s11 p + k32 * s12 p = k11 * s13 p + k12 * s23 p /\
  k31 * s12 p + k32 * s22 p = k21 * s13 p + k22 * s23 p.
Proof. intros d p D; cbv zeta; unfold gain_1, gain_2; repeat split; field; exact D. Qed.

Lemma measurement_update_seen : forall d s c n z1 z2 w p y1 y2 y,
  c * c + n * n = 1 -> at_angle c n (x s) z1 z2 w -> seen c n (P s) p -> det_S d p <> 0 -> r d <> 0 ->
  y 1%nat 1%nat = c * y1 - n * y2 -> y 2%nat 1%nat = n * y1 + c * y2 ->
  at_angle c n (x (measurement_update d s y))
    (z1 + (s11 (corrected d p) * (y1 - z1) + s12 (corrected d p) * (y2 - z2)) / r d)
    (z2 + (s12 (corrected d p) * (y1 - z1) + s22 (corrected d p) * (y2 - z2)) / r d)
    (w + (s13 (corrected d p) * (y1 - z1) + s23 (corrected d p) * (y2 - z2)) / r d) /\
  seen c n (P (measurement_update d s y)) (corrected d p).
Proof.
  intros d [X A] c n z1 z2 w p y1 y2 y unit (X1 & X2 & X3) (A11 & A12 & A21 & A22 & A13 & A31 & A23 & A32 & A33) D r0 Y1 Y2.
  assert (square : c * c = 1 - n * n) by lra.
  destruct (corrected_is_gain d p D r0) as (G1 & G2 & G3 & G4 & G5 & G6).
  assert (det : ((A 1%nat 1%nat + r d) * (A 2%nat 2%nat + r d) - A 1%nat 2%nat * A 2%nat 1%nat) = det_S d p).
  { cbn [P] in *; rewrite A11, A12, A21, A22; unfold det_S; ring [square]. }
  pose proof (gain_entries d A) as entries; cbv zeta in entries; rewrite det in entries.
  destruct (entries 1%nat) as [K11 K12], (entries 2%nat) as [K21 K22], (entries 3%nat) as [K31 K32].
  clear entries.
  assert (turned : (
     gain d A 1%nat 1%nat = c * (c * gain_1 d p (s11 p) (s12 p) - n * gain_1 d p (s12 p) (s22 p))
                   - n * (c * gain_2 d p (s11 p) (s12 p) - n * gain_2 d p (s12 p) (s22 p)) /\
     gain d A 1%nat 2%nat = n * (c * gain_1 d p (s11 p) (s12 p) - n * gain_1 d p (s12 p) (s22 p))
                   + c * (c * gain_2 d p (s11 p) (s12 p) - n * gain_2 d p (s12 p) (s22 p)) /\
     gain d A 2%nat 1%nat = c * (n * gain_1 d p (s11 p) (s12 p) + c * gain_1 d p (s12 p) (s22 p))
                   - n * (n * gain_2 d p (s11 p) (s12 p) + c * gain_2 d p (s12 p) (s22 p)) /\
     gain d A 2%nat 2%nat = n * (n * gain_1 d p (s11 p) (s12 p) + c * gain_1 d p (s12 p) (s22 p))
                   + c * (n * gain_2 d p (s11 p) (s12 p) + c * gain_2 d p (s12 p) (s22 p)) /\
     gain d A 3%nat 1%nat = c * gain_1 d p (s13 p) (s23 p) - n * gain_2 d p (s13 p) (s23 p) /\
     gain d A 3%nat 2%nat = n * gain_1 d p (s13 p) (s23 p) + c * gain_2 d p (s13 p) (s23 p))).
  { rewrite K11, K12, K21, K22, K31, K32; cbn [P] in *.
    rewrite ?A11, ?A12, ?A21, ?A22, ?A13, ?A31, ?A23, ?A32; unfold gain_1, gain_2, Rdiv.
    repeat split; ring [square]. }
  clear K11 K12 K21 K22 K31 K32 det.
  destruct turned as (K11 & K12 & K21 & K22 & K31 & K32).
  assert (symmetric_gain : gain_1 d p (s12 p) (s22 p) = gain_2 d p (s11 p) (s12 p)).
  { apply (Rmult_eq_reg_l (r d)); [rewrite <- G2, <- G3; reflexivity | exact r0]. }
  split.
  - unfold at_angle, measurement_update; cbn [x P] in *.
    unfold plus, minus, times; cbv [sum]; rewrite ?K11, ?K12, ?K21, ?K22, ?K31, ?K32; unfold H; cbv [Nat.eqb].
    rewrite X1, X2, X3, Y1, Y2, G1, G2, G4, G5, G6, symmetric_gain.
    assert (cancel : forall g1 g2 i1 i2, (r d * g1 * i1 + r d * g2 * i2) / r d = g1 * i1 + g2 * i2) by (intros; field; exact r0).
    rewrite !cancel.
    set (k11 := gain_1 d p (s11 p) (s12 p)) in *; set (k12 := gain_2 d p (s11 p) (s12 p)) in *.
    set (k22 := gain_2 d p (s12 p) (s22 p)) in *.
    set (k31 := gain_1 d p (s13 p) (s23 p)) in *; set (k32 := gain_2 d p (s13 p) (s23 p)) in *.
    repeat split.
    + pose proof (turned_back c n (c * k11 - n * k12) (c * k12 - n * k22) (y1 - z1) (y2 - z2) unit); lra.
    + pose proof (turned_back c n (n * k11 + c * k12) (n * k12 + c * k22) (y1 - z1) (y2 - z2) unit); lra.
    + pose proof (turned_back c n k31 k32 (y1 - z1) (y2 - z2) unit); lra.
  - pose proof (corrected_is_symmetric d p D) as both; cbv zeta in both.
    unfold seen, measurement_update; cbn [x P] in *.
    unfold plus, minus, times; cbv [sum]; rewrite ?K11, ?K12, ?K21, ?K22, ?K31, ?K32; unfold H; cbv [Nat.eqb].
    rewrite ?A11, ?A12, ?A21, ?A22, ?A13, ?A31, ?A23, ?A32, ?A33; unfold corrected; cbn [s11 s12 s13 s22 s23 s33].
    set (k11 := gain_1 d p (s11 p) (s12 p)) in *; set (k12 := gain_2 d p (s11 p) (s12 p)) in *.
    set (k21 := gain_1 d p (s12 p) (s22 p)) in *; set (k22 := gain_2 d p (s12 p) (s22 p)) in *.
    set (k31 := gain_1 d p (s13 p) (s23 p)) in *; set (k32 := gain_2 d p (s13 p) (s23 p)) in *.
    destruct p as [p11 p12 p13 p22 p23 p33]; cbn [s11 s12 s13 s22 s23 s33] in *.
    clear - unit both; clearbody k11 k12 k21 k22 k31 k32; destruct both as (E12 & E13 & E23).
    pose proof (f_equal (Rmult (c * c)) E12); pose proof (f_equal (Rmult (n * n)) E12).
    pose proof (f_equal (Rmult (c * n)) E12); pose proof (f_equal (Rmult c) E13); pose proof (f_equal (Rmult n) E13).
    pose proof (f_equal (Rmult c) E23); pose proof (f_equal (Rmult n) E23).
    pose (row_1 := fun k l : R => c * k - n * l); pose (row_2 := fun k l : R => n * k + c * l).
    repeat split.
    + pose proof (turned_back c n (row_1 k11 k21) (row_1 k12 k22) (row_1 p11 p12) (row_1 p12 p22) unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n (row_1 k11 k21) (row_1 k12 k22) (row_2 p11 p12) (row_2 p12 p22) unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n (row_2 k11 k21) (row_2 k12 k22) (row_1 p11 p12) (row_1 p12 p22) unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n (row_2 k11 k21) (row_2 k12 k22) (row_2 p11 p12) (row_2 p12 p22) unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n (row_1 k11 k21) (row_1 k12 k22) p13 p23 unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n k31 k32 (row_1 p11 p12) (row_1 p12 p22) unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n (row_2 k11 k21) (row_2 k12 k22) p13 p23 unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n k31 k32 (row_2 p11 p12) (row_2 p12 p22) unit); subst row_1 row_2; cbv beta in *; lra.
    + pose proof (turned_back c n k31 k32 p13 p23 unit); subst row_1 row_2; cbv beta in *; lra.
Qed.
