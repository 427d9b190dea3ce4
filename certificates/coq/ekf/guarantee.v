From Coq Require Import Reals Lra Psatz QArith Qreals Qminmax List.
From Interval Require Import Interval Xreal.
From Veritrack Require Import filter frame error order induction positive leaf cell cover.
Import ListNotations.
Local Open Scope R_scope.

(* The numbers of a certificate, and what they guarantee. *)
Record certificate := {
  set : set_Q;
  noise_bound : Q; slew_bound : Q;
  amplitude_error : Q; phase_error : Q; frequency_error : Q; (* at the start *)
  start_lo : symmetric_Q; start_hi : symmetric_Q;
  half_width_1 : Q; half_width_2 : Q; error_bound : Q; (* a box around the ellipsoid e' M e <= 1 *)
  ultimate_level : Q; settled_after : nat; settled_bound : Q;
  cells : tree }.

Definition guarantee (c : certificate) : Prop :=
  forall (phi omega v1 v2 : nat -> R) (a psi nu : R) (m : symmetric),
  (forall k, phi (S k) = phi k + omega k) ->
  (forall k, v1 k ^ 2 + v2 k ^ 2 <= Q2R (noise_bound c) ^ 2) ->
  (forall k, Rabs (omega (S k) - omega k) <= Q2R (slew_bound c)) ->
  Rabs a <= Q2R (amplitude_error c) -> Rabs psi <= Q2R (phase_error c) -> Rabs nu <= Q2R (frequency_error c) ->
  below (to_R (start_lo c)) m -> below m (to_R (start_hi c)) ->
  let estimates := run (design_of (set c)) (start_estimate (phi 0%nat) (omega 0%nat) a psi nu m) (measurement phi v1 v2) in
  (forall k, Rabs (x (estimates k) 3%nat 1%nat - omega k) <= Q2R (error_bound c)) /\
  (forall k, (settled_after c <= k)%nat -> Rabs (x (estimates k) 3%nat 1%nat - omega k) <= Q2R (settled_bound c)).

(* half^2 e'Me - (one of the errors)^2 *)
Definition width_terms {T} (ops : scalar T) (c : set_Q) (half : Q) (i : nat) : list (@term T) :=
  form_terms ops (number ops (half * half)%Q) (set_M c) (variable ops 0) (variable ops 1) (variable ops 2) ++
  [(minus_one ops, variable ops i, variable ops i)].
Lemma width_terms_hold : forall c half i, Forall2 term_holds (width_terms intervals c half i) (width_terms reals c half i).
Proof. intros; unfold width_terms; hold_all. Qed.

Fixpoint power (q : Q) (n : nat) : Q := match n with O => 1%Q | S m => (q * power q m)%Q end.
Lemma power_is : forall q n, Q2R (power q n) = Q2R q ^ n.
Proof.
  induction n as [| n IH]; cbn [power pow]; [unfold Q2R; simpl; lra | rewrite Q2R_mult, IH; reflexivity].
Qed.

(* The start covariances, turned by the phase error, are checked as the covariances of a cell are. *)
Definition start_leaf (c : certificate) : leaf := Build_leaf (start_lo c) (start_hi c) 0 0 0 0 0 0 1 1.
Definition root (c : certificate) : box :=
  Build_box (- half_width_1 c) (half_width_1 c) (- half_width_2 c) (half_width_2 c) (- error_bound c) (error_bound c).
Definition start_level (c : certificate) : interval :=
  let psi := hull (- phase_error c) (phase_error c) in let nu := hull (- frequency_error c) (frequency_error c) in
  let m := largest_square (- phase_error c) (phase_error c) in
  let length := interval_add (one intervals) (hull (- amplitude_error c) (amplitude_error c)) in
  level_over (set_M (set c))
    (interval_add (interval_multiply length (cosine intervals psi (g_over m))) (minus_one intervals))
    (interval_multiply length (interval_multiply psi (s_over m))) nu.

Definition check_start (c : certificate) : bool :=
  let m := largest_square (- phase_error c) (phase_error c) in
  let psi := hull (- phase_error c) (phase_error c) in
  Qle_bool m 1 &&
  is_positive (interval_add (one intervals) (interval_multiply (minus_one intervals) (start_level c))) &&
  positive 3 (turned_upper_terms intervals (set c) (start_leaf c) psi (g_over m) (s_over m)) &&
  positive 3 (turned_lower_terms intervals (set c) (start_leaf c) psi (g_over m) (s_over m)).
Definition check_bounds (c : certificate) : bool :=
  let s := set c in let u := ultimate_level c in
  Qle_bool 0 (half_width_1 c) && Qle_bool 0 (half_width_2 c) && Qle_bool 0 (error_bound c) && Qle_bool 0 (settled_bound c) &&
  Qle_bool 0 (set_noise_gain s) && Qle_bool 0 (set_slew_gain s) && Qle_bool 0 (set_kappa2 s) &&
  negb (Qle_bool (1 - set_kappa2 s) 0) && Qle_bool 0 u && Qle_bool u 1 &&
  Qle_bool (set_noise_gain s * (noise_bound c * noise_bound c) + set_slew_gain s * (slew_bound c * slew_bound c))
    ((1 - set_kappa2 s) * u) &&
  Qle_bool ((power (set_kappa2 s) (settled_after c) * (1 - u) + u) * (error_bound c * error_bound c))
    (settled_bound c * settled_bound c) &&
  positive 3 (width_terms intervals s (half_width_1 c) 0) && positive 3 (width_terms intervals s (half_width_2 c) 1) &&
  positive 3 (width_terms intervals s (error_bound c) 2).
Definition check (c : certificate) : bool :=
  check_set (set c) && check_bounds c && check_start c && check_tree (set c) (root c) (cells c).

Lemma Rabs_between : forall a b, - b <= a <= b -> Rabs a <= b.
Proof. intros a b A; apply Rabs_le; exact A. Qed.
Lemma between_Rabs : forall a b, Rabs a <= b -> - b <= a <= b.
Proof. intros a b A; unfold Rabs in A; destruct (Rcase_abs a); lra. Qed.
Lemma square_below : forall a b, 0 <= b -> a * a <= b * b -> Rabs a <= b.
Proof. intros a b B A; apply Rabs_between; split; nra. Qed.

Section Guarantee.
Variable c : certificate.
Hypothesis checked : check c = true.
Let s := set c.
Let o := ellipsoid_of s.

Lemma width : forall half e1 e2 nu bound, 0 <= Q2R half ->
  forall i, (i < 3)%nat -> positive 3 (width_terms intervals s half i) = true -> form (to_R (set_M s)) e1 e2 nu <= bound ->
  nth i [e1; e2; nu] 0 * nth i [e1; e2; nu] 0 <= Q2R half * Q2R half * bound.
Proof.
  intros half e1 e2 nu bound half0 i small A level.
  pose proof (positive_sound _ _ _ [e1; e2; nu] (width_terms_hold s half i) eq_refl A) as V.
  unfold width_terms in V; read_terms V; rewrite Q2R_mult in V.
  assert (0 <= Q2R half * Q2R half) by nra.
  pose proof (Rmult_le_compat_l _ _ _ H level); cbn [nth]; lra.
Qed.

Lemma kept_everywhere : forall e1 e2 nu, form (M o) e1 e2 nu <= 1 -> step_is_kept (design_of s) o e1 e2 nu.
Proof.
  intros e1 e2 nu level; unfold check in checked.
  pose proof checked as all; apply andb_prop in all; destruct all as [all tree_checked].
  apply andb_prop in all; destruct all as [all _]; apply andb_prop in all; destruct all as [set_checked bounds].
  unfold check_bounds in bounds; cbv zeta in bounds; split_check bounds.
  apply (tree_sound s set_checked (cells c) (root c)); [exact tree_checked | | exact level].
  cbn [o ellipsoid_of M] in level.
  repeat match goal with H : Qle_bool 0 _ = true |- _ => apply Q_not_negative in H end.
  assert (W1 : e1 * e1 <= Q2R (half_width_1 c) * Q2R (half_width_1 c) * 1)
    by (apply (width (half_width_1 c) e1 e2 nu 1) with (i := 0%nat); [assumption | lia | assumption | exact level]).
  assert (W2 : e2 * e2 <= Q2R (half_width_2 c) * Q2R (half_width_2 c) * 1)
    by (apply (width (half_width_2 c) e1 e2 nu 1) with (i := 1%nat); [assumption | lia | assumption | exact level]).
  assert (W3 : nu * nu <= Q2R (error_bound c) * Q2R (error_bound c) * 1)
    by (apply (width (error_bound c) e1 e2 nu 1) with (i := 2%nat); [assumption | lia | assumption | exact level]).
  rewrite Rmult_1_r in W1, W2, W3.
  apply square_below in W1; [| assumption]; apply square_below in W2; [| assumption]; apply square_below in W3; [| assumption].
  apply between_Rabs in W1; apply between_Rabs in W2; apply between_Rabs in W3.
  unfold lies_in, root; cbn [e1_lo e1_hi e2_lo e2_hi nu_lo nu_hi]; rewrite !Q2R_opp; tauto.
Qed.

Lemma start_inside : forall phi omega a psi nu m,
  Rabs a <= Q2R (amplitude_error c) -> Rabs psi <= Q2R (phase_error c) -> Rabs nu <= Q2R (frequency_error c) ->
  below (to_R (start_lo c)) m -> below m (to_R (start_hi c)) ->
  is_inside o (start_estimate phi omega a psi nu m) phi omega 1.
Proof.
  intros phi omega a psi nu m A B N L U.
  pose proof checked as all; unfold check in all; apply andb_prop in all; destruct all as [all _].
  apply andb_prop in all; destruct all as [all start]; clear all.
  unfold check_start in start; cbv zeta in start; split_check start.
  apply between_Rabs in A; apply between_Rabs in B; apply between_Rabs in N; rewrite <- Q2R_opp in A, B, N.
  destruct (sine_and_cosine_over _ _ _ B start) as (g & z & G & Z & Gh & Zh).
  apply hull_holds in A; apply hull_holds in B; apply hull_holds in N.
  exists ((1 + a) * cos psi - 1), ((1 + a) * sin psi), nu, (turned (cos psi) (sin psi) m).
  split; [split |].
  - unfold start_estimate, at_angle; cbn [x]; unfold vector_3; rewrite cos_plus, sin_plus; repeat split; ring.
  - apply seen_turned; [pose proof (sin2_cos2 phi); unfold Rsqr in *; lra |].
    pose proof (seen_turn (phi + psi) m) as S; rewrite cos_plus, sin_plus in S; exact S.
  - split; [| split].
    + apply (turned_above_lo s (start_leaf c) psi g z G Z); [| exact L].
      intros y size; eapply positive_sound; [apply turned_lower_terms_hold; eassumption | exact size | assumption].
    + apply (turned_below_hi s (start_leaf c) psi g z G Z); [| exact U].
      intros y size; eapply positive_sound; [apply turned_upper_terms_hold; eassumption | exact size | assumption].
    + assert (0 < one reals + minus_one reals * form (to_R (set_M s)) ((1 + a) * cos psi - 1) ((1 + a) * sin psi) nu).
      { eapply is_positive_sound; [| eassumption]; apply add_holds; [apply one_holds |].
        apply multiply_holds; [apply minus_one_holds |]; unfold start_level; apply level_over_holds.
        - replace ((1 + a) * cos psi - 1) with ((one reals + a) * cosine reals psi g + minus_one reals)
            by (rewrite one_is, minus_one_is, cosine_is, G; ring).
          apply add_holds; [apply multiply_holds; [apply add_holds; [apply one_holds | assumption] |] | apply minus_one_holds].
          apply cosine_holds; assumption.
        - rewrite Z, <- one_is; repeat apply multiply_holds; try assumption; apply add_holds; [apply one_holds | assumption].
        - assumption. }
      rewrite one_is, minus_one_is in *; cbn [o ellipsoid_of M]; lra.
Qed.

Theorem check_sound : guarantee c.
Proof.
  intros phi omega v1 v2 a psi nu m tone noise slew A B N L U estimates.
  pose proof (start_inside _ (omega 0%nat) _ _ _ _ A B N L U : is_inside o _ (phi 0%nat) _ 1) as inside.
  pose proof checked as all; unfold check in all; apply andb_prop in all; destruct all as [all _].
  apply andb_prop in all; destruct all as [all _]; apply andb_prop in all; destruct all as [set_checked bounds].
  unfold check_set in set_checked; split_check set_checked.
  assert (r_0 : 0 < r (design_of s)) by (apply Q_positive; assumption).
  unfold check_bounds in bounds; cbv zeta in bounds; split_check bounds.
  assert (one : Q2R 1 = 1) by (unfold Q2R; simpl; lra).
  assert (square : forall q, (Q2R q) * Q2R q = Q2R q ^ 2) by (intro; ring).
  repeat match goal with
    | H : Qle_bool 0 _ = true |- _ => apply Q_not_negative in H
    | H : negb (Qle_bool (1 - _) 0) = true |- _ => apply Q_positive in H; rewrite Q2R_minus, one in H
    | H : Qle_bool _ _ = true |- _ => apply Qle_bool_iff, Qle_Rle in H;
        rewrite ?Q2R_plus, ?Q2R_mult, ?Q2R_plus, ?Q2R_mult, ?Q2R_minus, ?power_is, ?one in H end.
  repeat match goal with H : context [set c] |- _ => progress change (set c) with s in H end.
  pose proof (inside_for_ever (design_of s) o (Q2R (noise_bound c)) (Q2R (slew_bound c)) (Q2R (ultimate_level c)) r_0
    kept_everywhere) as kept.
  cbn [o ellipsoid_of kappa2 noise_gain slew_gain] in kept.
  assert (for_ever : forall k, is_inside o (estimates k) (phi k) (omega k) (bound_at o (Q2R (ultimate_level c)) k)).
  { apply kept; try assumption.
    - split; [assumption | lra].
    - split; assumption.
    - split; assumption.
    - intro k; pose proof (noise k) as n; clear - n; cbn [pow] in n; lra.
    - intro k; pose proof (slew k) as w; apply between_Rabs in w; clear - w; nra. }
  clear kept.
  assert (bounded : forall k bound, 0 <= bound ->
    bound_at o (Q2R (ultimate_level c)) k * (Q2R (error_bound c) * Q2R (error_bound c)) <= bound * bound ->
    Rabs (x (estimates k) 3%nat 1%nat - omega k) <= bound).
  { intros k bound bound0 enough; destruct (for_ever k) as (e1 & e2 & n & p & [(_ & _ & X) _] & _ & _ & level).
    rewrite X; replace (omega k + n - omega k) with n by ring; apply square_below; [exact bound0 |].
    assert (W : n * n <= Q2R (error_bound c) * Q2R (error_bound c) * bound_at o (Q2R (ultimate_level c)) k)
      by (apply (width (error_bound c) e1 e2 n) with (i := 2%nat); [assumption | lia | assumption | exact level]).
    lra. }
  assert (widths : 0 <= Q2R (error_bound c) * Q2R (error_bound c)) by (apply Rmult_le_pos; assumption).
  split; intros k; [| intro late]; apply bounded; try assumption.
  - pose proof (bound_at_most_1 o (Q2R (ultimate_level c))) as B1; cbn [o ellipsoid_of kappa2] in B1.
    specialize (B1 ltac:(split; [assumption | lra]) ltac:(split; assumption) k).
    pose proof (Rmult_le_compat_r _ _ _ widths B1); cbn [o]; lra.
  - unfold bound_at; cbn [o ellipsoid_of kappa2].
    eapply Rle_trans; [| eassumption]; apply Rmult_le_compat_r; [exact widths |]; apply Rplus_le_compat_r.
    apply Rmult_le_compat_r; [lra |].
    assert (kappa : 0 <= Q2R (set_kappa2 s) <= 1) by (split; [assumption | lra]).
    clear - late kappa; induction late as [| k late IH]; [apply Rle_refl |].
    cbn [pow]; eapply Rle_trans; [| exact IH].
    pose proof (pow_le _ k (proj1 kappa)); nra.
Qed.
End Guarantee.
