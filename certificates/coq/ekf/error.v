From Coq Require Import Reals Lra Psatz.
From Veritrack Require Import filter frame.
Local Open Scope R_scope.

(* One step for the errors in the frame of the true phase: e1 + i e2 = z exp(-i phi) - 1, nu = x3 - omega. There the
   covariance turns by the known phase of the signal and by nu, so that P after the step does not depend on its noise
   and no argument of a complex number is taken. *)
Definition turned (c n : R) (m : symmetric) : symmetric :=
  Symmetric (c * c * s11 m - 2 * c * n * s12 m + n * n * s22 m) (c * n * (s11 m - s22 m) + (c * c - n * n) * s12 m)
            (c * s13 m - n * s23 m) (n * n * s11 m + 2 * c * n * s12 m + c * c * s22 m) (n * s13 m + c * s23 m) (s33 m).

Lemma turned_form : forall c n m a b z, form (turned c n m) a b z = form m (c * a + n * b) (c * b - n * a) z.
Proof. intros; unfold form, turned; cbn [s11 s12 s13 s22 s23 s33]; ring. Qed.

Lemma seen_turned : forall c n c' n' A m, c * c + n * n = 1 ->
  seen (c * c' - n * n') (n * c' + c * n') A m -> seen c n A (turned c' n' m).
Proof.
  intros c n c' n' A m unit (A11 & A12 & A21 & A22 & A13 & A31 & A23 & A32 & A33).
  unfold seen, turned; cbn [s11 s12 s13 s22 s23 s33].
  rewrite A11, A12, A21, A22, A13, A31, A23, A32, A33; repeat split; ring.
Qed.

(* The invariant: the state s at the true phase phi and frequency omega has the errors e and the covariance p. *)
Definition has_errors (s : estimate) (phi omega e1 e2 nu : R) (p : symmetric) : Prop :=
  at_angle (cos phi) (sin phi) (x s) (1 + e1) e2 (omega + nu) /\ seen (cos phi) (sin phi) (P s) p.

(* The corrected covariance in the frame of the prediction. *)
Definition next (d : noise_model) (e1 e2 : R) (p : symmetric) : symmetric := corrected d (predicted d (1 + e1) e2 p).

(* With the innovation i = u - (h1, h2), u the noise in the frame of the prediction. *)
Theorem step_errors : forall d s phi omega e1 e2 nu p v1 v2 omega',
  r d <> 0 -> det_S d (predicted d (1 + e1) e2 p) <> 0 -> has_errors s phi omega e1 e2 nu p ->
  let m := next d e1 e2 p in
  let h1 := 1 + e1 - cos nu in let h2 := e2 + sin nu in
  exists u1 u2, u1 * u1 + u2 * u2 = v1 * v1 + v2 * v2 /\
  let i1 := u1 - h1 in let i2 := u2 - h2 in
  let a1 := h1 + (s11 m * i1 + s12 m * i2) / r d in
  let a2 := h2 + (s12 m * i1 + s22 m * i2) / r d in
  let a3 := nu + (s13 m * i1 + s23 m * i2) / r d in
  has_errors (step d s (vector_2 (cos (phi + omega) + v1) (sin (phi + omega) + v2))) (phi + omega) omega'
    (cos nu * a1 - sin nu * a2) (sin nu * a1 + cos nu * a2) (a3 - (omega' - omega)) (turned (cos nu) (sin nu) m).
Proof.
  intros d s phi omega e1 e2 nu p v1 v2 omega' r0 D [X S] m h1 h2.
  set (w := omega + nu) in *; set (theta := phi + w).
  assert (unit : forall a, cos a * cos a + sin a * sin a = 1) by (intro a; pose proof (sin2_cos2 a); unfold Rsqr in *; lra).
  destruct (time_update_seen d s _ _ _ _ _ _ (unit phi) X S) as [X' S'].
  rewrite <- cos_plus, <- (Rplus_comm (cos phi * sin w)) in X', S'.
  rewrite (Rplus_comm (cos phi * sin w)), <- sin_plus in X', S'; fold theta in X', S'.
  exists (cos theta * v1 + sin theta * v2), (cos theta * v2 - sin theta * v1).
  assert (P1 : phi + omega = theta - nu) by (unfold theta, w; ring).
  split.
  { transitivity ((cos theta * cos theta + sin theta * sin theta) * (v1 * v1 + v2 * v2)); [ring | rewrite unit; ring]. }
  intros i1 i2 a1 a2 a3.
  pose proof (cos_minus theta nu) as C; pose proof (sin_minus theta nu) as N; rewrite <- P1 in C, N.
  destruct (measurement_update_seen d (time_update d s) _ _ _ _ _ _
    (cos nu + (cos theta * v1 + sin theta * v2)) (- sin nu + (cos theta * v2 - sin theta * v1))
    (vector_2 (cos (phi + omega) + v1) (sin (phi + omega) + v2)) (unit theta) X' S' D r0) as [X'' S''].
  { cbn [vector_2]; unfold vector_2; rewrite C.
    transitivity (cos theta * cos nu + sin theta * sin nu + (cos theta * cos theta + sin theta * sin theta) * v1);
      [rewrite unit; ring | ring]. }
  { unfold vector_2; rewrite N.
    transitivity (sin theta * cos nu - cos theta * sin nu + (cos theta * cos theta + sin theta * sin theta) * v2);
      [rewrite unit; ring | ring]. }
  fold (next d e1 e2 p) in X'', S''; fold m in X'', S''.
  assert (cos_theta : cos theta = cos (phi + omega) * cos nu - sin (phi + omega) * sin nu).
  { rewrite <- cos_plus; f_equal; unfold theta, w; ring. }
  assert (sin_theta : sin theta = sin (phi + omega) * cos nu + cos (phi + omega) * sin nu).
  { rewrite <- sin_plus; f_equal; unfold theta, w; ring. }
  split.
  - destruct X'' as (X1 & X2 & X3); unfold step, at_angle; rewrite X1, X2, X3.
    set (g1 := (s11 m * _ + s12 m * _) / r d); set (g2 := (s12 m * _ + s22 m * _) / r d).
    set (g3 := (s13 m * _ + s23 m * _) / r d).
    assert (E1 : a1 = h1 + g1) by (unfold a1, g1, i1, i2, h1, h2; f_equal; f_equal; ring).
    assert (E2 : a2 = h2 + g2) by (unfold a2, g2, i1, i2, h1, h2; f_equal; f_equal; ring).
    assert (E3 : a3 = nu + g3) by (unfold a3, g3, i1, i2, h1, h2; f_equal; f_equal; ring).
    rewrite E1, E2, E3; clearbody g1 g2 g3; rewrite cos_theta, sin_theta; unfold h1, h2.
    pose proof (unit nu) as U.
    pose proof (f_equal (Rmult (cos (phi + omega))) U); pose proof (f_equal (Rmult (sin (phi + omega))) U).
    repeat split; [lra | lra | unfold w; ring].
  - apply seen_turned; [apply unit |]; rewrite <- cos_theta, <- sin_theta; exact S''.
Qed.
