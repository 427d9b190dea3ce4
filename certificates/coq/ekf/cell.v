From Coq Require Import Reals Lra Psatz QArith Qreals List.
From Veritrack Require Import filter frame error order induction positive leaf.
Import ListNotations.
Local Open Scope R_scope.

(* What the forms of a cell say, over the reals. *)
Lemma value_app : forall s t y, value (s ++ t) y = value s y + value t y.
Proof. induction s as [| [[w l] m] s IH]; intros t y; simpl; rewrite ?IH; ring. Qed.
Lemma one_is : one reals = 1.
Proof. unfold one, reals, Q2R; simpl; lra. Qed.
Lemma minus_one_is : minus_one reals = -1.
Proof. unfold minus_one, reals, Q2R; simpl; lra. Qed.
Lemma dot_variable : forall i y, dot (variable reals i) y = nth i y 0.
Proof.
  induction i as [| i IH]; intros [| a y]; [reflexivity | | reflexivity |].
  - cbn [variable dot nth]; rewrite one_is; destruct y; cbn; ring.
  - cbn [variable dot nth]; rewrite IH; cbn [zero reals]; ring.
Qed.
Lemma dot_difference : forall l m y, dot (difference reals l m) y = dot l y - dot m y.
Proof. intros; unfold difference; rewrite dot_added, dot_scaled, minus_one_is; ring. Qed.
Lemma value_form : forall w m a b c y,
  value (form_terms reals w m a b c) y = w * form (to_R m) (dot a y) (dot b y) (dot c y).
Proof. intros; unfold form_terms, form, to_R; cbn [value reals number add multiply s11 s12 s13 s22 s23 s33]; ring. Qed.
Lemma cosine_is : forall nu g, cosine reals nu g = 1 - nu * (nu * g).
Proof. intros; unfold cosine; rewrite one_is, minus_one_is; cbn [reals add multiply]; ring. Qed.
Lemma dot_nil : forall y, dot [] y = 0.
Proof. destruct y; reflexivity. Qed.
Lemma Q2R_half : Q2R (1 # 2) = 1 / 2.
Proof. unfold Q2R; simpl; lra. Qed.
Lemma Q2R_minus_2 : Q2R (-2) = -2.
Proof. unfold Q2R; simpl; lra. Qed.

Lemma half_form : forall l u a b c, form (half l u) a b c = 1 / 2 * (form u a b c - form l a b c).
Proof. intros; unfold form, half; cbn [s11 s12 s13 s22 s23 s33]; lra. Qed.

Ltac read_terms H :=
  cbv zeta in H; repeat rewrite ?value_app, ?value_form, ?dot_added, ?dot_scaled, ?dot_difference, ?dot_variable,
    ?dot_nil, ?one_is, ?minus_one_is, ?cosine_is in H;
  cbn [value nth reals add multiply number] in H;
  repeat rewrite ?value_app, ?value_form, ?dot_added, ?dot_scaled, ?dot_difference, ?dot_variable,
    ?dot_nil, ?one_is, ?minus_one_is, ?cosine_is in H; cbn [nth reals add multiply number] in H.

Section Cell.
Variable c : set_Q.
Variable b : leaf.
Let d := design_of c.
Let o := ellipsoid_of c.
Hypothesis q1_0 : 0 <= Q2R (design_q1 c).
Hypothesis q2_0 : 0 <= Q2R (design_q2 c).
Hypothesis r_0 : 0 < Q2R (design_r c).
Hypothesis lo_0 : not_negative (to_R (set_lo c)).
Hypothesis inverse : forall y, length y = 3%nat -> 0 <= value (inverse_terms reals c) y.

Lemma level_is_reached : forall a1 a2 a3, let m := to_R (set_M c) in
  exists b1 b2 b3, form m a1 a2 a3 <= 2 * (b1 * a1 + b2 * a2 + b3 * a3) - form (to_R (set_N c)) b1 b2 b3.
Proof.
  intros a1 a2 a3 m.
  exists (s11 m * a1 + s12 m * a2 + s13 m * a3), (s12 m * a1 + s22 m * a2 + s23 m * a3), (s13 m * a1 + s23 m * a2 + s33 m * a3).
  pose proof (inverse [a1; a2; a3] eq_refl) as N; unfold inverse_terms in N; read_terms N.
  unfold m; cbn [to_R s11 s12 s13 s22 s23 s33].
  match type of N with _ <= _ + (_ * ?f) => set (n := f) in * end.
  fold (to_R (set_N c)); fold n; unfold form in *; cbn [to_R s11 s12 s13 s22 s23 s33] in *; lra.
Qed.

Variables e1 e2 : R.
Hypothesis upper : forall y, length y = 3%nat -> 0 <= value (upper_terms reals c b e1 e2) y.
Hypothesis lower : forall y, length y = 5%nat -> 0 <= value (lower_terms reals c b e1 e2) y.

Lemma below_hi : forall p, not_negative p -> below p (to_R (set_hi c)) -> below (next d e1 e2 p) (to_R (x_hi b)).
Proof.
  intros p P B; unfold next.
  apply (corrected_upper d r_0 _ (predicted d (1 + e1) e2 (to_R (set_hi c))) _
    (Q2R (k11 b)) (Q2R (k12 b)) (Q2R (k21 b)) (Q2R (k22 b)) (Q2R (k31 b)) (Q2R (k32 b))).
  - apply (predicted_not_negative d q1_0 q2_0); exact P.
  - apply (predicted_below d); exact B.
  - intros a b' z k1 k2; rewrite predicted_form.
    pose proof (upper [a; b'; z] eq_refl) as U; unfold upper_terms, predicted_terms in U; read_terms U.
    unfold k1, k2, d; cbn [design_of q1 q2 r].
    match type of U with _ <= 1 * ?g + (-1 * ?f + _) => set (n := f) in *; set (top := g) in * end.
    match goal with |- ?f + _ + _ + _ <= _ => replace f with n by (unfold n; f_equal; ring) end.
    lra.
Qed.

Lemma above_lo : forall p, not_negative p -> below (to_R (set_lo c)) p -> below (to_R (x_lo b)) (next d e1 e2 p).
Proof.
  intros p P B; unfold next.
  apply (corrected_lower d r_0 _ (predicted d (1 + e1) e2 (to_R (set_lo c)))).
  - apply (predicted_not_negative d q1_0 q2_0); exact P.
  - apply (predicted_below d); exact B.
  - intros a b' z k1 k2; rewrite predicted_form.
    pose proof (lower [a; b'; z; k1; k2] eq_refl) as L; unfold lower_terms, predicted_terms in L; read_terms L.
    unfold d; cbn [design_of q1 q2 r].
    match type of L with _ <= -1 * ?g + (1 * ?f + _) => set (n := f) in *; set (bottom := g) in * end.
    match goal with |- _ <= ?f + _ + _ + _ => replace f with n by (unfold n; f_equal; ring) end.
    lra.
Qed.

Variables nu g s : R.
Hypothesis cosine_g : cos nu = 1 - nu * (nu * g).
Hypothesis sine_s : sin nu = nu * s.
Hypothesis turned_upper : forall y, length y = 3%nat -> 0 <= value (turned_upper_terms reals c b nu g s) y.
Hypothesis turned_lower : forall y, length y = 3%nat -> 0 <= value (turned_lower_terms reals c b nu g s) y.
Hypothesis lambda_0 : 0 < Q2R (lambda b).
Hypothesis multipliers : 1 <= Q2R (lambda b) * Q2R (mu b) * (Q2R (design_r c) * Q2R (design_r c)).
Hypothesis error : forall y, length y = 9%nat -> 0 <= value (error_terms reals c b nu g s) y.

Lemma turned_below_hi : forall m, below m (to_R (x_hi b)) -> below (turned (cos nu) (sin nu) m) (to_R (set_hi c)).
Proof.
  intros m B a b' z; rewrite turned_form; eapply Rle_trans; [apply B |].
  pose proof (turned_upper [a; b'; z] eq_refl) as U; unfold turned_upper_terms, turned_back_terms in U; read_terms U.
  rewrite <- cosine_g, <- sine_s in U; lra.
Qed.
Lemma turned_above_lo : forall m, below (to_R (x_lo b)) m -> below (to_R (set_lo c)) (turned (cos nu) (sin nu) m).
Proof.
  intros m B a b' z; rewrite turned_form; eapply Rle_trans; [| apply B].
  pose proof (turned_lower [a; b'; z] eq_refl) as U; unfold turned_lower_terms, turned_back_terms in U; read_terms U.
  rewrite <- cosine_g, <- sine_s in U; lra.
Qed.

Theorem cell_is_kept : step_is_kept d o e1 e2 nu.
Proof.
  intros p L U; cbn [o ellipsoid_of p_lo p_hi] in L, U.
  assert (P : not_negative p) by (intros x y z; pose proof (L x y z); pose proof (lo_0 x y z); lra).
  split; [apply Rgt_not_eq, (det_S_positive d r_0), (predicted_not_negative d q1_0 q2_0), P |].
  pose proof (below_hi p P U) as top; pose proof (above_lo p P L) as bottom.
  intro m; fold m in top, bottom.
  split; [apply turned_above_lo, bottom |]; split; [apply turned_below_hi, top |].
  intros u1 u2 w; cbn [o ellipsoid_of M kappa2 noise_gain slew_gain].
  unfold next_error, level; cbv zeta; cbn [d design_of r].
  replace (1 + e1 - cos nu) with (e1 + nu * g * nu) by (rewrite cosine_g; ring).
  replace (e2 + sin nu) with (e2 + s * nu) by (rewrite sine_s; ring).
  set (h1 := e1 + nu * g * nu); set (h2 := e2 + s * nu).
  match goal with |- form _ ?x ?y ?z <= _ => destruct (level_is_reached x y z) as (b1 & b2 & b3 & reached) end.
  eapply Rle_trans; [exact reached |]; clear reached.
  assert (order : below (to_R (x_lo b)) (to_R (x_hi b))).
  { intros x y z; eapply Rle_trans; [apply bottom | apply top]. }
  pose proof (young _ _ m (Q2R (lambda b)) (Q2R (mu b)) (Q2R (design_r c)) (cos nu * b1 + sin nu * b2)
    (cos nu * b2 - sin nu * b1) b3 (u1 - h1) (u2 - h2) bottom top order lambda_0 r_0 multipliers) as Y.
  pose proof (error [b1; b2; b3; u1; u2; w; e1; e2; nu] eq_refl) as E.
  unfold error_terms, half_terms, middle_over_r in E; read_terms E.
  rewrite <- cosine_g, <- sine_s in E.
  rewrite Q2R_half, Q2R_minus_2 in E.
  fold h1 h2 in E.
  assert (inverse_2_r : Q2R (/ (2 * design_r c)) = / Q2R (design_r c) * (1 / 2)).
  { rewrite Q2R_inv, Q2R_mult; [| intro Z; apply Qeq_eqR in Z; rewrite Q2R_mult in Z; unfold Q2R in Z at 1 3; simpl in Z; lra].
    unfold Q2R at 1; simpl; field; apply Rgt_not_eq; exact r_0. }
  rewrite inverse_2_r in E; clear inverse_2_r.
  rewrite !half_form in Y; unfold pairing, middle in Y; cbn [to_R s11 s12 s13 s22 s23 s33] in Y.
  unfold Rdiv in *; set (rho := / Q2R (design_r c)) in *.
  repeat match type of E with context [form ?a ?x ?y ?z] => set (form a x y z) in * end.
  clearbody h1 h2; set (i1 := u1 - h1) in *; set (i2 := u2 - h2) in *; clearbody i1 i2 rho m.
  clear - Y E.
  set (cn := cos nu) in *; set (sn := sin nu) in *; clearbody cn sn.
  lra.
Qed.
End Cell.
