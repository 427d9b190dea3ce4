From Coq Require Import Reals Lra Psatz QArith Qreals Qminmax List.
From Interval Require Import Interval Xreal.
From Veritrack Require Import filter frame error order induction positive leaf cell.
Import ListNotations.
Local Open Scope R_scope.

(* An interval between two fractions. *)
Definition some_interval (a : interval) : I.type := match a with Some i => i | None => I.zero end.
Definition hull (lo hi : Q) : interval :=
  Some (I.join (some_interval (interval_number lo)) (some_interval (interval_number hi))).

Lemma some_interval_contains : forall a x, holds a x -> contains (I.convert (some_interval a)) (Xreal x).
Proof.
  intros [i |] x A; [exact A |]; unfold holds in A; subst; unfold some_interval; rewrite I.zero_correct; simpl; lra.
Qed.
Lemma hull_holds : forall lo hi x, Q2R lo <= x <= Q2R hi -> holds (hull lo hi) x.
Proof.
  intros lo hi x between; unfold hull, holds.
  set (l := some_interval (interval_number lo)); set (h := some_interval (interval_number hi)).
  apply (contains_connected (I.convert (I.join l h)) (Q2R lo) (Q2R hi)); [| | exact between].
  - apply I.join_correct; left; apply some_interval_contains, number_holds.
  - apply I.join_correct; right; apply some_interval_contains, number_holds.
Qed.

(* cos nu = 1 - nu (nu g) and sin nu = nu s with g near 1/2 and s near 1. *)
Lemma sine_and_cosine : forall nu m, nu * nu <= m <= 1 -> exists g s,
  cos nu = 1 - nu * (nu * g) /\ sin nu = nu * s /\ 1 / 2 - m / 24 <= g <= 1 / 2 /\ 1 - m / 6 <= s <= 1.
Proof.
  assert (positive_case : forall nu m, 0 < nu -> nu * nu <= m <= 1 -> exists g s,
    cos nu = 1 - nu * (nu * g) /\ sin nu = nu * s /\ 1 / 2 - m / 24 <= g <= 1 / 2 /\ 1 - m / 6 <= s <= 1).
  { intros nu m nu0 range; assert (nu <= 1) by nra; pose proof PI2_1.
    exists ((1 - cos nu) / (nu * nu)), (sin nu / nu).
    split; [field; lra |]; split; [field; lra |].
    destruct (cos_bound nu 0) as [c1 c2]; [lra | lra |].
    destruct (sin_bound nu 0) as [s1 s2]; [lra | lra |].
    pose proof (sin_lt_x nu nu0).
    unfold cos_approx, sin_approx, cos_term, sin_term in *; simpl in c1, c2, s1, s2.
    assert (square : 0 < nu * nu) by nra.
    repeat split; [| | |].
    - apply (Rmult_le_reg_r (nu * nu)); [exact square |].
      replace ((1 - cos nu) / (nu * nu) * (nu * nu)) with (1 - cos nu) by (field; lra). nra.
    - apply (Rmult_le_reg_r (nu * nu)); [exact square |].
      replace ((1 - cos nu) / (nu * nu) * (nu * nu)) with (1 - cos nu) by (field; lra). nra.
    - apply (Rmult_le_reg_r nu); [exact nu0 |].
      replace (sin nu / nu * nu) with (sin nu) by (field; lra). nra.
    - apply (Rmult_le_reg_r nu); [exact nu0 |].
      replace (sin nu / nu * nu) with (sin nu) by (field; lra). lra. }
  intros nu m range; destruct (Rtotal_order 0 nu) as [A | [A | A]].
  - apply positive_case; assumption.
  - subst nu; exists (1 / 2), 1; rewrite cos_0, sin_0; repeat split; lra.
  - destruct (positive_case (- nu) m) as (g & s & C & N & G & Z); [lra | lra |].
    exists g, s; rewrite cos_neg in C; rewrite sin_neg in N; repeat split; lra.
Qed.

Definition largest_square (lo hi : Q) : Q := Qmax (lo * lo) (hi * hi).
Lemma largest_square_bounds : forall lo hi x, Q2R lo <= x <= Q2R hi -> x * x <= Q2R (largest_square lo hi).
Proof.
  intros lo hi x between.
  pose proof (Qle_Rle _ _ (Q.le_max_l (lo * lo) (hi * hi))) as A; pose proof (Qle_Rle _ _ (Q.le_max_r (lo * lo) (hi * hi))) as B.
  rewrite Q2R_mult in A, B; unfold largest_square; destruct (Rle_dec 0 x); nra.
Qed.
Definition g_over (m : Q) : interval := hull ((1 # 2) - m * (1 # 24)) (1 # 2).
Definition s_over (m : Q) : interval := hull (1 - m * (1 # 6)) 1.

Lemma sine_and_cosine_over : forall lo hi nu, Q2R lo <= nu <= Q2R hi -> Qle_bool (largest_square lo hi) 1 = true ->
  exists g s, cos nu = 1 - nu * (nu * g) /\ sin nu = nu * s /\
    holds (g_over (largest_square lo hi)) g /\ holds (s_over (largest_square lo hi)) s.
Proof.
  intros lo hi nu between small; pose proof (largest_square_bounds _ _ _ between) as square.
  apply Qle_bool_iff, Qle_Rle in small; set (m := largest_square lo hi) in *.
  assert (one : Q2R 1 = 1) by (unfold Q2R; simpl; lra); rewrite one in small.
  destruct (sine_and_cosine nu (Q2R m)) as (g & s & C & S & G & Z); [lra |].
  exists g, s; split; [exact C |]; split; [exact S |].
  split; apply hull_holds; rewrite ?Q2R_minus, ?Q2R_mult, ?one; unfold Q2R in *; simpl in *; lra.
Qed.

(* The cover of the ellipsoid: boxes cut in two, down to boxes that are checked or lie outside it. *)
Inductive tree :=
  | Checked (b : leaf) | Outside
  | Cut_e1 (at_ : Q) (below above : tree) | Cut_e2 (at_ : Q) (below above : tree) | Cut_nu (at_ : Q) (below above : tree).

Definition level_over (m : symmetric_Q) (e1 e2 nu : interval) : interval :=
  let '(add, multiply) := (interval_add, interval_multiply) in
  let n (q : Q) := interval_number q in
  let two_times a := add a a in
  add (add (multiply (multiply (n (q11 m)) e1) e1) (add (multiply (multiply (n (q22 m)) e2) e2) (multiply (multiply (n (q33 m)) nu) nu)))
      (two_times (add (multiply (multiply (n (q12 m)) e1) e2)
                      (add (multiply (multiply (n (q13 m)) e1) nu) (multiply (multiply (n (q23 m)) e2) nu)))).
Lemma level_over_holds : forall m e1 e2 nu x1 x2 x3, holds e1 x1 -> holds e2 x2 -> holds nu x3 ->
  holds (level_over m e1 e2 nu) (form (to_R m) x1 x2 x3).
Proof.
  intros m e1 e2 nu x1 x2 x3 A B C; unfold level_over.
  replace (form (to_R m) x1 x2 x3) with
    ((Q2R (q11 m) * x1 * x1 + (Q2R (q22 m) * x2 * x2 + Q2R (q33 m) * x3 * x3)) +
     ((Q2R (q12 m) * x1 * x2 + (Q2R (q13 m) * x1 * x3 + Q2R (q23 m) * x2 * x3)) +
      (Q2R (q12 m) * x1 * x2 + (Q2R (q13 m) * x1 * x3 + Q2R (q23 m) * x2 * x3))))
    by (unfold form, to_R; cbn [s11 s12 s13 s22 s23 s33]; ring).
  repeat first [assumption | simple apply number_holds | simple apply add_holds | simple apply multiply_holds].
Qed.
Definition is_positive (a : interval) : bool :=
  match a with Some i => match I.sign_strict i with Xgt => true | _ => false end | None => false end.
Lemma is_positive_sound : forall a x, holds a x -> is_positive a = true -> 0 < x.
Proof.
  intros [i |] x A check; unfold is_positive in check; [| discriminate].
  pose proof (I.sign_strict_correct i) as sign; destruct (I.sign_strict i); try discriminate.
  exact (proj2 (sign _ A)).
Qed.

Definition check_leaf (c : set_Q) (x : box) (b : leaf) : bool :=
  let m := largest_square (nu_lo x) (nu_hi x) in
  let e1 := hull (e1_lo x) (e1_hi x) in let e2 := hull (e2_lo x) (e2_hi x) in
  let nu := hull (nu_lo x) (nu_hi x) in let g := g_over m in let s := s_over m in
  Qle_bool m 1 && negb (Qle_bool (lambda b) 0) && Qle_bool 1 (lambda b * mu b * (design_r c * design_r c)) &&
  positive 3 (upper_terms intervals c b e1 e2) && positive 5 (lower_terms intervals c b e1 e2) &&
  positive 3 (turned_upper_terms intervals c b nu g s) && positive 3 (turned_lower_terms intervals c b nu g s) &&
  positive 9 (error_terms intervals c b nu g s).
Definition is_outside (c : set_Q) (x : box) : bool :=
  is_positive (interval_add (level_over (set_M c) (hull (e1_lo x) (e1_hi x)) (hull (e2_lo x) (e2_hi x))
    (hull (nu_lo x) (nu_hi x))) (interval_number (-1))).
Fixpoint check_tree (c : set_Q) (x : box) (t : tree) : bool :=
  let '(a, a', b, b', n, n') := (e1_lo x, e1_hi x, e2_lo x, e2_hi x, nu_lo x, nu_hi x) in
  match t with
  | Checked l => check_leaf c x l
  | Outside => is_outside c x
  | Cut_e1 q l u => check_tree c (Build_box a q b b' n n') l && check_tree c (Build_box q a' b b' n n') u
  | Cut_e2 q l u => check_tree c (Build_box a a' b q n n') l && check_tree c (Build_box a a' q b' n n') u
  | Cut_nu q l u => check_tree c (Build_box a a' b b' n q) l && check_tree c (Build_box a a' b b' q n') u end.

(* What every cell relies on. *)
Definition check_set (c : set_Q) : bool :=
  Qle_bool 0 (design_q1 c) && Qle_bool 0 (design_q2 c) && negb (Qle_bool (design_r c) 0) &&
  positive 3 (form_terms intervals (one intervals) (set_lo c) (variable intervals 0) (variable intervals 1) (variable intervals 2)) &&
  positive 3 (inverse_terms intervals c).

Ltac split_check H := repeat match type of H with (_ && _ = true)%bool =>
  let L := fresh "C" in apply andb_prop in H; destruct H as [H L] end.
Lemma Q_positive : forall q, negb (Qle_bool q 0) = true -> 0 < Q2R q.
Proof.
  intros q A; apply Bool.negb_true_iff in A; destruct (Rlt_le_dec 0 (Q2R q)) as [B | B]; [exact B |].
  assert (Qle_bool q 0 = true); [| congruence].
  apply Qle_bool_iff, Rle_Qle; unfold Q2R at 2; simpl; lra.
Qed.
Lemma Q_not_negative : forall q, Qle_bool 0 q = true -> 0 <= Q2R q.
Proof. intros q A; apply Qle_bool_iff, Qle_Rle in A; unfold Q2R at 1 in A; simpl in A; lra. Qed.

Section Tree.
Variable c : set_Q.
Hypothesis set_checked : check_set c = true.

Lemma leaf_sound : forall x b e1 e2 nu, check_leaf c x b = true -> lies_in x e1 e2 nu ->
  step_is_kept (design_of c) (ellipsoid_of c) e1 e2 nu.
Proof.
  intros x b e1 e2 nu check (E1 & E2 & N); unfold check_leaf in check; cbv zeta in check; split_check check.
  pose proof set_checked as set_check; unfold check_set in set_check; split_check set_check.
  destruct (sine_and_cosine_over _ _ _ N check) as (g & s & G & S & Gh & Sh).
  apply hull_holds in E1; apply hull_holds in E2; apply hull_holds in N.
  apply (cell_is_kept c b) with (g := g) (s := s).
  - apply Q_not_negative; assumption.
  - apply Q_not_negative; assumption.
  - apply Q_positive; assumption.
  - intros a b' z.
    assert (V : 0 <= value (form_terms reals (one reals) (set_lo c) (variable reals 0) (variable reals 1) (variable reals 2)) [a; b'; z]).
    { apply (positive_sound 3 (form_terms intervals (one intervals) (set_lo c) (variable intervals 0) (variable intervals 1)
          (variable intervals 2))); [hold_all | reflexivity | assumption]. }
    read_terms V; lra.
  - intros y size; eapply positive_sound; [apply inverse_terms_hold | exact size | assumption].
  - intros y size; eapply positive_sound; [apply upper_terms_hold; eassumption | exact size | assumption].
  - intros y size; eapply positive_sound; [apply lower_terms_hold; eassumption | exact size | assumption].
  - exact G.
  - exact S.
  - intros y size; eapply positive_sound; [apply turned_upper_terms_hold; eassumption | exact size | assumption].
  - intros y size; eapply positive_sound; [apply turned_lower_terms_hold; eassumption | exact size | assumption].
  - apply Q_positive; assumption.
  - match goal with H : Qle_bool 1 _ = true |- _ => apply Qle_bool_iff, Qle_Rle in H; rewrite !Q2R_mult in H;
      unfold Q2R at 1 in H; simpl in H; lra end.
  - intros y size; eapply positive_sound; [apply error_terms_hold; eassumption | exact size | assumption].
Qed.

Lemma tree_sound : forall t x e1 e2 nu, check_tree c x t = true -> lies_in x e1 e2 nu ->
  form (to_R (set_M c)) e1 e2 nu <= 1 -> step_is_kept (design_of c) (ellipsoid_of c) e1 e2 nu.
Proof.
  induction t as [b | | q l IHl u IHu | q l IHl u IHu | q l IHl u IHu]; intros x e1 e2 nu check inside level;
    cbn [check_tree] in check; pose proof inside as (E1 & E2 & N).
  - eapply leaf_sound; eassumption.
  - exfalso; unfold is_outside in check.
    assert (0 < form (to_R (set_M c)) e1 e2 nu + Q2R (-1)).
    { eapply is_positive_sound; [| exact check]; apply add_holds; [| apply number_holds].
      apply level_over_holds; apply hull_holds; assumption. }
    unfold Q2R in *; simpl in *; lra.
  - apply andb_prop in check; destruct check as [A B]; destruct (Rle_dec e1 (Q2R q));
      [eapply IHl | eapply IHu]; try eassumption; unfold lies_in; cbn [e1_lo e1_hi e2_lo e2_hi nu_lo nu_hi]; lra.
  - apply andb_prop in check; destruct check as [A B]; destruct (Rle_dec e2 (Q2R q));
      [eapply IHl | eapply IHu]; try eassumption; unfold lies_in; cbn [e1_lo e1_hi e2_lo e2_hi nu_lo nu_hi]; lra.
  - apply andb_prop in check; destruct check as [A B]; destruct (Rle_dec nu (Q2R q));
      [eapply IHl | eapply IHu]; try eassumption; unfold lies_in; cbn [e1_lo e1_hi e2_lo e2_hi nu_lo nu_hi]; lra.
Qed.
End Tree.
