From Coq Require Import Reals Lra Lia Psatz QArith Qreals List.
From Veritrack Require Import filter frame error order induction positive leaf cell cover guarantee.
Import ListNotations.
Local Open Scope R_scope.

(* The steady state lies between two matrices X and Y where a step at zero errors takes X below theta X, theta < 1, and Y
   above Y / theta: with c >= 1 it takes c X below c theta X, so that from P* <= c X follows P* <= c theta X, and so on
   until c is 1; likewise from below. *)
Lemma form_multiple : forall k m a b z, form (multiple k m) a b z = k * form m a b z.
Proof. intros; unfold form, multiple; cbn [s11 s12 s13 s22 s23 s33]; ring. Qed.

Section Scaling.
Variable d : noise_model.
Hypothesis q1_0 : 0 <= q1 d.
Hypothesis q2_0 : 0 <= q2 d.
Hypothesis r_0 : 0 < r d.
Variable bound : symmetric.
Variable theta : R.

Definition noise_form (a b z k1 k2 : R) : R :=
  q1 d * ((a - k1) * (a - k1) + (b - k2) * (b - k2)) + q2 d * (z * z) + r d * (k1 * k1 + k2 * k2).
Lemma noise_form_0 : forall a b z k1 k2, 0 <= noise_form a b z k1 k2.
Proof. intros; unfold noise_form; pose proof (Rle_0_sqr (a - k1)); pose proof (Rle_0_sqr (b - k2)); unfold Rsqr in *; nra. Qed.

Lemma scaled_upper : forall k11 k12 k21 k22 k31 k32,
  (forall a b z, let k1 := k11 * a + k21 * b + k31 * z in let k2 := k12 * a + k22 * b + k32 * z in
     form bound (a - k1) (b - k2) (z + (b - k2)) + noise_form a b z k1 k2 <= theta * form bound a b z) ->
  forall c p, 1 <= c -> not_negative p -> below p (multiple c bound) -> below (next d 0 0 p) (multiple (c * theta) bound).
Proof.
  intros k11 k12 k21 k22 k31 k32 kept c p c1 P B; unfold next.
  apply (corrected_upper d r_0 _ (predicted d (1 + 0) 0 (multiple c bound)) _ k11 k12 k21 k22 k31 k32).
  - apply (predicted_not_negative d q1_0 q2_0); exact P.
  - apply (predicted_below d); exact B.
  - intros a b z k1 k2; rewrite predicted_form, !form_multiple.
    specialize (kept a b z); cbv zeta in kept; fold k1 k2 in kept.
    replace (z - 0 * (a - k1) + (1 + 0) * (b - k2)) with (z + (b - k2)) by ring.
    pose proof (noise_form_0 a b z k1 k2) as N; pose proof (Rmult_le_compat_l c _ _ ltac:(lra) kept) as K.
    pose proof (Rmult_le_pos (c - 1) _ ltac:(lra) N); unfold noise_form in *; lra.
Qed.

Lemma scaled_lower :
  (forall a b z k1 k2, theta * form bound a b z <= form bound (a - k1) (b - k2) (z + (b - k2)) + noise_form a b z k1 k2) ->
  forall c p, 0 <= c <= 1 -> not_negative p -> below (multiple c bound) p -> below (multiple (c * theta) bound) (next d 0 0 p).
Proof.
  intros kept c p c1 P B; unfold next.
  apply (corrected_lower d r_0 _ (predicted d (1 + 0) 0 (multiple c bound))).
  - apply (predicted_not_negative d q1_0 q2_0); exact P.
  - apply (predicted_below d); exact B.
  - intros a b z k1 k2; rewrite predicted_form, !form_multiple; specialize (kept a b z k1 k2).
    replace (z - 0 * (a - k1) + (1 + 0) * (b - k2)) with (z + (b - k2)) by ring.
    pose proof (noise_form_0 a b z k1 k2) as N; pose proof (Rmult_le_compat_l c _ _ ltac:(lra) kept) as K.
    pose proof (Rmult_le_pos (1 - c) _ ltac:(lra) N); unfold noise_form in *; lra.
Qed.
End Scaling.

(* is_steady, as the filter's own words have it, is a fixed point of the step at zero errors. *)
Lemma steady_is_fixed : forall d m, 0 <= q1 d -> 0 <= q2 d -> 0 < r d -> is_steady d m -> m = next d 0 0 m.
Proof.
  intros d m Q1 Q2 R0 [M fixed].
  assert (D : det_S d (predicted d (1 + 0) 0 m) <> 0).
  { apply Rgt_not_eq, (det_S_positive d R0), (predicted_not_negative d Q1 Q2); exact M. }
  assert (E : has_errors {| x := vector_3 1 0 0; P := full m |} 0 0 0 0 0 m).
  { unfold has_errors, at_angle, seen; cbn [x P]; unfold vector_3, full, matrix_3_3; rewrite cos_0, sin_0.
    repeat split; ring. }
  destruct (step_errors d _ 0 0 0 0 0 m 0 0 0 (Rgt_not_eq _ _ R0) D E) as (u1 & u2 & _ & after); cbv zeta in after.
  destruct after as [_ S]; rewrite Rplus_0_l, cos_0, sin_0, !Rplus_0_r in S.
  unfold seen in S; destruct S as (A11 & A12 & _ & A22 & A13 & _ & A23 & _ & A33).
  set (n := next d 0 0 m) in *.
  rewrite fixed in A11, A12, A22, A13, A23, A33 by lia.
  unfold full, matrix_3_3, turned in *; cbn [s11 s12 s13 s22 s23 s33] in *.
  destruct m as [m11 m12 m13 m22 m23 m33], n as [n11 n12 n13 n22 n23 n33]; cbn [s11 s12 s13 s22 s23 s33] in *.
  f_equal; lra.
Qed.

(* A covariance is below some multiple of a matrix that is above a multiple of 1. *)
Lemma below_some_multiple : forall m bound least, (forall a b z, 0 <= form m a b z) -> 0 < least ->
  (forall a b z, least * (a * a + b * b + z * z) <= form bound a b z) -> exists c, 1 <= c /\ below m (multiple c bound).
Proof.
  intros m bound least M least0 B.
  set (t := 3 * (s11 m + s22 m + s33 m)).
  assert (D : 0 <= s11 m /\ 0 <= s22 m /\ 0 <= s33 m).
  { pose proof (M 1 0 0); pose proof (M 0 1 0); pose proof (M 0 0 1); unfold form in *; lra. }
  assert (T : forall a b z, form m a b z <= t * (a * a + b * b + z * z)).
  { intros a b z; pose proof (M a (- b) 0); pose proof (M a 0 (- z)); pose proof (M 0 b (- z)).
    pose proof (Rle_0_sqr a); pose proof (Rle_0_sqr b); pose proof (Rle_0_sqr z); unfold Rsqr, t in *.
    assert (form m a b z <= 3 * (s11 m * (a * a) + s22 m * (b * b) + s33 m * (z * z))) by (unfold form in *; lra).
    destruct D as (D1 & D2 & D3).
    pose proof (Rmult_le_pos (s11 m) (b * b + z * z) D1 ltac:(lra)).
    pose proof (Rmult_le_pos (s22 m) (a * a + z * z) D2 ltac:(lra)).
    pose proof (Rmult_le_pos (s33 m) (a * a + b * b) D3 ltac:(lra)); lra. }
  exists (1 + t / least); assert (0 <= t) by (unfold t; lra).
  assert (0 <= t / least) by (apply Rmult_le_pos; [assumption | left; apply Rinv_0_lt_compat; exact least0]).
  split; [lra |]; intros a b z; rewrite form_multiple.
  pose proof (B a b z) as L; pose proof (Rmult_le_compat_l (t / least) _ _ ltac:(assumption) L) as S.
  replace (t / least * (least * (a * a + b * b + z * z))) with (t * (a * a + b * b + z * z)) in S by (field; lra).
  pose proof (T a b z); pose proof (Rle_0_sqr a); pose proof (Rle_0_sqr b); pose proof (Rle_0_sqr z); unfold Rsqr in *.
  pose proof (Rmult_le_pos least (a * a + b * b + z * z) ltac:(lra) ltac:(lra)); lra.
Qed.

Lemma from_above : forall m bound theta c0, 0 <= theta < 1 -> (forall a b z, 0 <= form bound a b z) -> 1 <= c0 ->
  below m (multiple c0 bound) -> (forall c, 1 <= c -> below m (multiple c bound) -> below m (multiple (c * theta) bound)) ->
  below m bound.
Proof.
  intros m bound theta c0 range B c1 start shrinks.
  assert (all : forall n, below m (multiple (Rmax 1 (c0 * theta ^ n)) bound)).
  { induction n as [| n IH].
    - cbn [pow]; rewrite Rmult_1_r, Rmax_right by exact c1; exact start.
    - intros a b z; pose proof (shrinks _ (Rmax_l 1 (c0 * theta ^ n)) IH a b z) as S.
      rewrite form_multiple in *; pose proof (B a b z) as F.
      eapply Rle_trans; [exact S |]; apply Rmult_le_compat_r; [exact F |]; cbn [pow].
      unfold Rmax at 1; destruct (Rle_dec 1 (c0 * theta ^ n)).
      + replace (c0 * (theta * theta ^ n)) with (c0 * theta ^ n * theta) by ring; apply Rmax_r.
      + eapply Rle_trans; [| apply Rmax_l]; lra. }
  destruct (pow_lt_1_zero theta ltac:(rewrite Rabs_right; lra) (/ c0) ltac:(apply Rinv_0_lt_compat; lra)) as [n N].
  specialize (N n (le_n n)); rewrite Rabs_right in N by (apply Rle_ge, pow_le; lra).
  assert (small : c0 * theta ^ n <= 1).
  { apply (Rmult_le_reg_l (/ c0)); [apply Rinv_0_lt_compat; lra |].
    rewrite <- Rmult_assoc, Rinv_l, Rmult_1_l, Rmult_1_r by lra; lra. }
  intros a b z; pose proof (all n a b z) as A; rewrite form_multiple, Rmax_left in A by exact small; lra.
Qed.

Lemma from_below : forall m bound theta c0, 1 < theta -> (forall a b z, 0 <= form bound a b z) -> 0 < c0 <= 1 ->
  below (multiple c0 bound) m -> (forall c, 0 <= c <= 1 -> below (multiple c bound) m -> below (multiple (c * theta) bound) m) ->
  below bound m.
Proof.
  intros m bound theta c0 range B c1 start grows.
  assert (powers : forall n, 0 < theta ^ n) by (intro; apply pow_lt; lra).
  assert (all : forall n, below (multiple (Rmin 1 (c0 * theta ^ n)) bound) m).
  { induction n as [| n IH].
    - cbn [pow]; rewrite Rmult_1_r, Rmin_right by apply c1; exact start.
    - assert (0 < c0 * theta ^ n) by (apply Rmult_lt_0_compat; [apply c1 | apply powers]).
      assert (in_range : 0 <= Rmin 1 (c0 * theta ^ n) <= 1).
      { split; [apply Rmin_glb; lra | apply Rmin_l]. }
      intros a b z; pose proof (grows _ in_range IH a b z) as S.
      rewrite form_multiple in *; pose proof (B a b z) as F.
      eapply Rle_trans; [| exact S]; apply Rmult_le_compat_r; [exact F |]; cbn [pow].
      unfold Rmin at 2; destruct (Rle_dec 1 (c0 * theta ^ n)).
      + eapply Rle_trans; [apply Rmin_l |]; lra.
      + replace (c0 * (theta * theta ^ n)) with (c0 * theta ^ n * theta) by ring; apply Rmin_r. }
  destruct (Pow_x_infinity theta ltac:(rewrite Rabs_right; lra) (/ c0)) as [n N].
  specialize (N n (le_n n)); rewrite Rabs_right in N by (left; apply powers).
  assert (large : 1 <= c0 * theta ^ n).
  { apply Rge_le in N; apply (Rmult_le_compat_l c0) in N; [| lra]; rewrite Rinv_r in N by lra; exact N. }
  intros a b z; pose proof (all n a b z) as A; rewrite form_multiple, Rmin_left in A by exact large; lra.
Qed.

(* The check: upper and lower bound at the start are those X and Y, with stored gains; Y is above a share of 0's image, and X
   above a multiple of 1. *)
Record steady_numbers := { above : leaf; beneath : leaf; least_share : Q; least_size : Q }.
Definition theta_Q : Q := 999999 # 1000000.
Definition with_bounds (s : set_Q) (l h : symmetric_Q) : set_Q := {|
  design_q1 := design_q1 s; design_q2 := design_q2 s; design_r := design_r s; set_M := set_M s; set_N := set_N s;
  set_lo := l; set_hi := h; set_kappa2 := set_kappa2 s; set_noise_gain := set_noise_gain s; set_slew_gain := set_slew_gain s |}.
Definition with_limits (g : leaf) (l h : symmetric_Q) : leaf :=
  Build_leaf l h (k11 g) (k12 g) (k21 g) (k22 g) (k31 g) (k32 g) (lambda g) (mu g).
Definition none : symmetric_Q := Build_symmetric_Q 0 0 0 0 0 0.
Definition unit_Q (q : Q) : symmetric_Q := Build_symmetric_Q q 0 0 q 0 q.

Definition lowest (c : certificate) : symmetric_Q := multiple_Q (from_multiple c) (start_lo c).
Definition highest (c : certificate) : symmetric_Q := multiple_Q (to_multiple c) (start_hi c).
Definition difference_terms {T} (ops : scalar T) (m l : symmetric_Q) : list (@term T) :=
  form_terms ops (one ops) m (variable ops 0) (variable ops 1) (variable ops 2) ++
  form_terms ops (minus_one ops) l (variable ops 0) (variable ops 1) (variable ops 2).
Lemma difference_terms_hold : forall m l, Forall2 term_holds (difference_terms intervals m l) (difference_terms reals m l).
Proof. intros; unfold difference_terms; hold_all. Qed.

Definition check_steady (c : certificate) (n : steady_numbers) : bool :=
  let '(X, Y, s) := (highest c, lowest c, set c) in
  negb (Qle_bool (least_size n) 0) && negb (Qle_bool (least_share n) 0) && Qle_bool (least_share n) 1 &&
  positive 3 (difference_terms intervals X (unit_Q (least_size n))) &&
  positive 3 (difference_terms intervals Y none) &&
  positive 3 (upper_terms intervals (with_bounds s none X) (with_limits (above n) none (multiple_Q theta_Q X)) None None) &&
  positive 5 (lower_terms intervals (with_bounds s Y none) (with_limits (beneath n) (multiple_Q (/ theta_Q) Y) none) None None) &&
  positive 5 (lower_terms intervals (with_bounds s none none) (with_limits (beneath n) (multiple_Q (least_share n) Y) none) None None).

Section Steady.
Variable c : certificate.
Variable n : steady_numbers.
Hypothesis checked : check c = true.
Hypothesis steady_checked : check_steady c n = true.
Let d := design_of (set c).

Lemma difference_sound : forall m l, positive 3 (difference_terms intervals m l) = true ->
  forall a b z, form (to_R l) a b z <= form (to_R m) a b z.
Proof.
  intros m l A a b z; pose proof (positive_sound _ _ _ [a; b; z] (difference_terms_hold m l) eq_refl A) as V.
  unfold difference_terms in V; read_terms V; lra.
Qed.

Lemma read_lower : forall Y X, positive 5 (lower_terms intervals (with_bounds (set c) Y none)
    (with_limits (beneath n) X none) None None) = true ->
  forall a b z k1 k2, form (to_R X) a b z <= form (to_R Y) (a - k1) (b - k2) (z + (b - k2)) + noise_form d a b z k1 k2.
Proof.
  intros Y X A a b z k1 k2.
  set (g := beneath n) in *.
  set (n1 := k1 - (Q2R (k11 g) * a + Q2R (k21 g) * b + Q2R (k31 g) * z)).
  set (n2 := k2 - (Q2R (k12 g) * a + Q2R (k22 g) * b + Q2R (k32 g) * z)).
  pose proof (positive_sound _ _ _ [n1; n2; a; b; z]
    (lower_terms_hold (with_bounds (set c) Y none) (with_limits g X none) None None 0 0 eq_refl eq_refl) eq_refl A) as L.
  unfold lower_terms, predicted_terms in L; read_terms L.
  cbn [with_bounds with_limits set_lo x_lo k11 k12 k21 k22 k31 k32 design_q1 design_q2 design_r] in L.
  replace (n1 + (Q2R (k11 g) * a + Q2R (k21 g) * b + Q2R (k31 g) * z)) with k1 in L by (unfold n1; ring).
  replace (n2 + (Q2R (k12 g) * a + Q2R (k22 g) * b + Q2R (k32 g) * z)) with k2 in L by (unfold n2; ring).
  unfold noise_form, d; cbn [design_of q1 q2 r].
  match type of L with _ <= -1 * _ + (1 * ?f + _) => replace f with (form (to_R Y) (a - k1) (b - k2) (z + (b - k2))) in L
    by (f_equal; ring) end.
  lra.
Qed.

Theorem steady_is_between : forall m, is_steady d m ->
  below (multiple (Q2R (from_multiple c)) (to_R (start_lo c))) m /\
  below m (multiple (Q2R (to_multiple c)) (to_R (start_hi c))).
Proof.
  intros m S.
  pose proof checked as all; unfold check in all; apply andb_prop in all; destruct all as [all _].
  apply andb_prop in all; destruct all as [all _]; apply andb_prop in all; destruct all as [set_checked _].
  unfold check_set in set_checked; split_check set_checked.
  assert (r_0 : 0 < r d) by (apply Q_positive; assumption).
  assert (q1_0 : 0 <= q1 d) by (apply Q_not_negative; assumption).
  assert (q2_0 : 0 <= q2 d) by (apply Q_not_negative; assumption).
  pose proof (steady_is_fixed d m q1_0 q2_0 r_0 S) as fixed; destruct S as [M _].
  pose proof steady_checked as numbers; unfold check_steady in numbers; cbv zeta in numbers; split_check numbers.
  rewrite <- !multiple_is; fold (lowest c) (highest c).
  assert (one : Q2R 1 = 1) by (unfold Q2R; simpl; lra).
  assert (theta : Q2R theta_Q = 999999 / 1000000) by (unfold theta_Q, Q2R; simpl; lra).
  assert (theta' : Q2R (/ theta_Q) = 1000000 / 999999) by (unfold theta_Q, Q2R; simpl; lra).
  assert (zero : forall a b z, form (to_R none) a b z = 0).
  { intros; unfold form, to_R, none, Q2R; cbn; lra. }
  repeat match goal with
    | H : negb (Qle_bool _ 0) = true |- _ => apply Q_positive in H
    | H : Qle_bool _ 1 = true |- _ => apply Qle_bool_iff, Qle_Rle in H; rewrite one in H end.
  split.
  - match goal with H : positive 3 (difference_terms _ (lowest c) none) = true |- _ =>
      pose proof (difference_sound _ _ H) as Y0 end.
    assert (Y : forall a b z, 0 <= form (to_R (lowest c)) a b z) by (intros; rewrite <- (zero a b z); apply Y0).
    apply (from_below _ _ (Q2R (/ theta_Q)) (Q2R (least_share n))); [lra | exact Y | split; assumption | |].
    + match goal with H : positive 5 (lower_terms _ (with_bounds _ none none) _ _ _) = true |- _ =>
        pose proof (read_lower _ _ H) as L end.
      rewrite multiple_is in L; rewrite fixed.
      apply (corrected_lower d r_0 _ (predicted d (1 + 0) 0 (to_R none))).
      * apply (predicted_not_negative d q1_0 q2_0); exact M.
      * apply (predicted_below d); intros a b z; rewrite zero; apply M.
      * intros a b z k1 k2; rewrite predicted_form, zero; specialize (L a b z k1 k2); rewrite zero in L.
        unfold noise_form in L; lra.
    + intros k range B; rewrite fixed.
      match goal with H : positive 5 (lower_terms _ (with_bounds _ (lowest c) none) _ _ _) = true |- _ =>
        pose proof (read_lower _ _ H) as L end.
      rewrite multiple_is in L.
      apply (scaled_lower d q1_0 q2_0 r_0 (to_R (lowest c)) (Q2R (/ theta_Q))); try assumption.
      intros a b z k1 k2; rewrite <- form_multiple; apply L.
  - match goal with H : positive 3 (difference_terms _ (highest c) _) = true |- _ =>
      pose proof (difference_sound _ _ H) as X0 end.
    assert (X : forall a b z, Q2R (least_size n) * (a * a + b * b + z * z) <= form (to_R (highest c)) a b z).
    { intros a b z; specialize (X0 a b z).
      replace (form (to_R (unit_Q (least_size n))) a b z) with (Q2R (least_size n) * (a * a + b * b + z * z)) in X0; [exact X0 |].
      unfold form, to_R, unit_Q; cbn [q11 q12 q13 q22 q23 q33 s11 s12 s13 s22 s23 s33].
      replace (Q2R 0) with 0 by (unfold Q2R; simpl; lra); ring. }
    destruct (below_some_multiple m (to_R (highest c)) (Q2R (least_size n)) M ltac:(assumption) X) as (k & k1 & start).
    apply (from_above _ _ (Q2R theta_Q) k); [lra | | exact k1 | exact start |].
    { intros a b z; eapply Rle_trans; [| apply X]; apply Rmult_le_pos; [lra |].
      pose proof (Rle_0_sqr a); pose proof (Rle_0_sqr b); pose proof (Rle_0_sqr z); unfold Rsqr in *; lra. }
    intros k' range B; rewrite fixed at 1.
    match goal with H : positive 3 (upper_terms _ _ _ _ _) = true |- _ => rename H into U end.
    apply (scaled_upper d q1_0 q2_0 r_0 (to_R (highest c)) (Q2R theta_Q)
      (Q2R (k11 (above n))) (Q2R (k12 (above n))) (Q2R (k21 (above n))) (Q2R (k22 (above n))) (Q2R (k31 (above n)))
      (Q2R (k32 (above n)))); try assumption.
    intros a b z k1' k2'; set (g := above n) in *.
    pose proof (positive_sound _ _ _ [a; b; z]
      (upper_terms_hold (with_bounds (set c) none (highest c)) (with_limits g none (multiple_Q theta_Q (highest c))) None None 0 0
        eq_refl eq_refl) eq_refl U) as V.
    unfold upper_terms, predicted_terms in V; read_terms V.
    cbn [with_bounds with_limits set_hi x_hi k11 k12 k21 k22 k31 k32 design_q1 design_q2 design_r] in V.
    fold k1' k2' in V; rewrite multiple_is, form_multiple in V.
    unfold noise_form, d; cbn [design_of q1 q2 r].
    match type of V with _ <= 1 * _ + (-1 * ?f + _) => replace f with (form (to_R (highest c)) (a - k1') (b - k2') (z + (b - k2'))) in V
      by (f_equal; ring) end.
    lra.
Qed.
End Steady.
