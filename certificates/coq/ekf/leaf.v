From Coq Require Import Reals Lra Psatz QArith Qreals Qminmax List.
From Interval Require Import Xreal.
From Veritrack Require Import filter frame error order induction positive.
Import ListNotations.
Local Open Scope R_scope.

(* The numbers of a certificate are fractions. *)
Record symmetric_Q := { q11 : Q; q12 : Q; q13 : Q; q22 : Q; q23 : Q; q33 : Q }.
Definition to_R (m : symmetric_Q) : symmetric :=
  Symmetric (Q2R (q11 m)) (Q2R (q12 m)) (Q2R (q13 m)) (Q2R (q22 m)) (Q2R (q23 m)) (Q2R (q33 m)).

(* What is stored for a box of errors (e1, e2, nu): bounds on the covariance after the step before it is turned, a gain
   for the upper bound, and the multipliers of Young's inequality. *)
Record leaf := {
  x_lo : symmetric_Q; x_hi : symmetric_Q;
  k11 : Q; k12 : Q; k21 : Q; k22 : Q; k31 : Q; k32 : Q; lambda : Q; mu : Q }.
Record box := { e1_lo : Q; e1_hi : Q; e2_lo : Q; e2_hi : Q; nu_lo : Q; nu_hi : Q }.
Definition lies_in (b : box) (e1 e2 nu : R) : Prop :=
  Q2R (e1_lo b) <= e1 <= Q2R (e1_hi b) /\ Q2R (e2_lo b) <= e2 <= Q2R (e2_hi b) /\ Q2R (nu_lo b) <= nu <= Q2R (nu_hi b).

Record set_Q := {
  design_q1 : Q; design_q2 : Q; design_r : Q;
  set_M : symmetric_Q; set_N : symmetric_Q; set_lo : symmetric_Q; set_hi : symmetric_Q;
  set_kappa2 : Q; set_noise_gain : Q; set_slew_gain : Q }.
Definition design_of (c : set_Q) : noise_model :=
  {| q1 := Q2R (design_q1 c); q2 := Q2R (design_q2 c); r := Q2R (design_r c) |}.
Definition ellipsoid_of (c : set_Q) : ellipsoid := {|
  M := to_R (set_M c); p_lo := to_R (set_lo c); p_hi := to_R (set_hi c);
  kappa2 := Q2R (set_kappa2 c); noise_gain := Q2R (set_noise_gain c); slew_gain := Q2R (set_slew_gain c) |}.

Section Terms.
Context {T : Type}.
Variable ops : scalar T.
Notation "'$' q" := (number ops q) (at level 1).
Notation "a *: l" := (scaled ops a l) (at level 40).
Notation "l +: m" := (added ops l m) (at level 50, left associativity).

Definition one : T := $ 1%Q.
Definition minus_one : T := $ (-1)%Q.
Fixpoint variable (i : nat) : list T := match i with O => [one] | S j => zero ops :: variable j end.
Definition difference (l m : list T) : list T := l +: (minus_one *: m).

Definition form_terms (w : T) (m : symmetric_Q) (a b c : list T) : list (@term T) :=
  let twice := add ops w w in
  [(multiply ops w ($ (q11 m)), a, a); (multiply ops w ($ (q22 m)), b, b); (multiply ops w ($ (q33 m)), c, c);
   (multiply ops twice ($ (q12 m)), a, b); (multiply ops twice ($ (q13 m)), a, c); (multiply ops twice ($ (q23 m)), b, c)].

Variable c : set_Q.
Variable b : leaf.

(* F' (I - K H)' (a, b, z) for the estimate z1 + i z2 and Q in the frame. *)
Definition predicted_terms (w : T) (m : symmetric_Q) (z1 z2 : T) (a b z k1 k2 : list T) : list term :=
  let y1 := difference a k1 in let y2 := difference b k2 in
  form_terms w m y1 y2 (difference (z +: (z1 *: y2)) (z2 *: y1)) ++
  [(multiply ops w ($ (design_q1 c)), y1, y1); (multiply ops w ($ (design_q1 c)), y2, y2);
   (multiply ops w ($ (design_q2 c)), z, z);
   (multiply ops w ($ (design_r c)), k1, k1); (multiply ops w ($ (design_r c)), k2, k2)].

Definition upper_terms (e1 e2 : T) : list term :=
  let '(a, b', z) := (variable 0, variable 1, variable 2) in
  let k1 := ($ (k11 b) *: a) +: ($ (k21 b) *: b') +: ($ (k31 b) *: z) in
  let k2 := ($ (k12 b) *: a) +: ($ (k22 b) *: b') +: ($ (k32 b) *: z) in
  form_terms one (x_hi b) a b' z ++ predicted_terms minus_one (set_hi c) (add ops one e1) e2 a b' z k1 k2.

Definition lower_terms (e1 e2 : T) : list term :=
  let '(a, b', z) := (variable 0, variable 1, variable 2) in
  form_terms minus_one (x_lo b) a b' z ++
  predicted_terms one (set_lo c) (add ops one e1) e2 a b' z (variable 3) (variable 4).

(* cos nu = 1 - nu (nu g) and sin nu = nu s. *)
Definition cosine (nu g : T) : T := add ops one (multiply ops minus_one (multiply ops nu (multiply ops nu g))).
Definition turned_back_terms (w : T) (m : symmetric_Q) (nu g s : T) (a b z : list T) : list term :=
  form_terms w m ((cosine nu g *: a) +: (multiply ops nu s *: b)) (difference (cosine nu g *: b) (multiply ops nu s *: a)) z.
Definition turned_upper_terms (nu g s : T) : list term :=
  let '(a, b', z) := (variable 0, variable 1, variable 2) in
  form_terms one (set_hi c) a b' z ++ turned_back_terms minus_one (x_hi b) nu g s a b' z.
Definition turned_lower_terms (nu g s : T) : list term :=
  let '(a, b', z) := (variable 0, variable 1, variable 2) in
  form_terms minus_one (set_lo c) a b' z ++ turned_back_terms one (x_lo b) nu g s a b' z.

(* The middle over r, and half the difference. *)
Definition middle_over_r (f : symmetric_Q -> Q) : T :=
  multiply ops ($ (/ (2 * design_r c))%Q) (add ops ($ (f (x_lo b))) ($ (f (x_hi b)))).
Definition half_terms (w : T) (a b' z : list T) : list term :=
  form_terms (multiply ops w ($ (1 # 2))) (x_hi b) a b' z ++
  form_terms (multiply ops minus_one (multiply ops w ($ (1 # 2)))) (x_lo b) a b' z.

(* kappa^2 e'Me + gains - (2 b'e+ - b'Nb), with the unknown covariance by Young's inequality; the variables are
   b, u, w, e. *)
Definition error_terms (nu g s : T) : list term :=
  let '(b1, b2, b3, u1, u2, w) := (variable 0, variable 1, variable 2, variable 3, variable 4, variable 5) in
  let '(e1, e2, e3) := (variable 6, variable 7, variable 8) in
  let h1 := e1 +: (multiply ops nu g *: e3) in let h2 := e2 +: (s *: e3) in
  let i1 := difference u1 h1 in let i2 := difference u2 h2 in
  let a1 := h1 +: (middle_over_r q11 *: i1) +: (middle_over_r q12 *: i2) in
  let a2 := h2 +: (middle_over_r q12 *: i1) +: (middle_over_r q22 *: i2) in
  let a3 := e3 +: (middle_over_r q13 *: i1) +: (middle_over_r q23 *: i2) in
  let cosine := cosine nu g in let sine := multiply ops nu s in
  form_terms ($ (set_kappa2 c)) (set_M c) e1 e2 e3 ++
  form_terms one (set_N c) b1 b2 b3 ++
  half_terms (multiply ops minus_one ($ (lambda b))) ((cosine *: b1) +: (sine *: b2)) (difference (cosine *: b2) (sine *: b1)) b3 ++
  half_terms (multiply ops minus_one ($ (mu b))) i1 i2 [] ++
  [($ (set_noise_gain c), u1, u1); ($ (set_noise_gain c), u2, u2); ($ (set_slew_gain c), w, w);
   ($ (-2)%Q, b1, difference (cosine *: a1) (sine *: a2)); ($ (-2)%Q, b2, (sine *: a1) +: (cosine *: a2));
   ($ (-2)%Q, b3, difference a3 w)].

(* b'Nb <= e'Me for b = Me. *)
Definition inverse_terms : list term :=
  let '(a, b', z) := (variable 0, variable 1, variable 2) in
  let row (x y t : Q) := ($ x *: a) +: ($ y *: b') +: ($ t *: z) in
  form_terms one (set_M c) a b' z ++
  form_terms minus_one (set_N c) (row (q11 (set_M c)) (q12 (set_M c)) (q13 (set_M c)))
    (row (q12 (set_M c)) (q22 (set_M c)) (q23 (set_M c))) (row (q13 (set_M c)) (q23 (set_M c)) (q33 (set_M c))).
End Terms.

(* The same formulas over intervals hold the formulas over the reals. *)
Lemma zero_holds : holds (zero intervals) (zero reals).
Proof. reflexivity. Qed.
Lemma one_holds : holds (one intervals) (one reals).
Proof. apply number_holds. Qed.
Lemma minus_one_holds : holds (minus_one intervals) (minus_one reals).
Proof. apply number_holds. Qed.
Ltac hold_step := lazymatch goal with
  | |- holds (one _) _ => exact one_holds
  | |- holds (minus_one _) _ => exact minus_one_holds
  | |- holds (number _ _) _ => apply number_holds
  | |- holds (zero _) _ => exact zero_holds
  | |- holds (add _ _ _) _ => apply add_holds
  | |- holds (multiply _ _ _) _ => apply multiply_holds
  | |- Forall2 _ (_ ++ _) _ => apply Forall2_app
  | |- Forall2 _ [] _ => apply Forall2_nil
  | |- Forall2 _ (_ :: _) _ => apply Forall2_cons
  | |- Forall2 _ (added _ _ _) _ => apply added_holds
  | |- Forall2 _ (scaled _ _ _) _ => apply scaled_holds
  | |- term_holds _ _ => split; [| split]
  | |- _ => assumption end.
Ltac hold := cbv zeta; repeat hold_step.

Lemma variable_holds : forall i, Forall2 holds (variable intervals i) (variable reals i).
Proof. induction i; simpl; constructor; auto; [apply number_holds | reflexivity]. Qed.

Lemma form_terms_hold : forall w w' m a b c a' b' c', holds w w' -> Forall2 holds a a' -> Forall2 holds b b' ->
  Forall2 holds c c' -> Forall2 term_holds (form_terms intervals w m a b c) (form_terms reals w' m a' b' c').
Proof. intros; unfold form_terms; hold. Qed.

Lemma difference_holds : forall l m l' m', Forall2 holds l l' -> Forall2 holds m m' ->
  Forall2 holds (difference intervals l m) (difference reals l' m').
Proof. intros; unfold difference; hold. Qed.
Lemma cosine_holds : forall nu g nu' g', holds nu nu' -> holds g g' -> holds (cosine intervals nu g) (cosine reals nu' g').
Proof. intros; unfold cosine; hold. Qed.
Ltac hold_all := cbv zeta; repeat lazymatch goal with
  | |- holds (cosine _ _ _) _ => apply cosine_holds
  | |- Forall2 _ (variable _ _) _ => apply variable_holds
  | |- Forall2 _ (difference _ _ _) _ => apply difference_holds
  | |- Forall2 _ (form_terms _ _ _ _ _ _) _ => apply form_terms_hold
  | |- _ => hold_step end.

Section Hold.
Variable c : set_Q.
Lemma predicted_terms_hold : forall w w' m z1 z1' z2 z2' l1 l1' l2 l2' l3 l3' l4 l4' l5 l5', holds w w' -> holds z1 z1' ->
  holds z2 z2' -> Forall2 holds l1 l1' -> Forall2 holds l2 l2' -> Forall2 holds l3 l3' -> Forall2 holds l4 l4' ->
  Forall2 holds l5 l5' -> Forall2 term_holds (predicted_terms intervals c w m z1 z2 l1 l2 l3 l4 l5)
    (predicted_terms reals c w' m z1' z2' l1' l2' l3' l4' l5').
Proof. intros; unfold predicted_terms; hold_all. Qed.
Lemma turned_back_terms_hold : forall w w' m nu nu' g g' s s' l1 l1' l2 l2' l3 l3', holds w w' -> holds nu nu' ->
  holds g g' -> holds s s' -> Forall2 holds l1 l1' -> Forall2 holds l2 l2' -> Forall2 holds l3 l3' ->
  Forall2 term_holds (turned_back_terms intervals w m nu g s l1 l2 l3) (turned_back_terms reals w' m nu' g' s' l1' l2' l3').
Proof. intros; unfold turned_back_terms; hold_all. Qed.
Variable b : leaf.
Lemma middle_holds : forall f, holds (middle_over_r intervals c b f) (middle_over_r reals c b f).
Proof. intros; unfold middle_over_r; hold_all. Qed.
Lemma half_terms_hold : forall w w' l1 l1' l2 l2' l3 l3', holds w w' -> Forall2 holds l1 l1' -> Forall2 holds l2 l2' ->
  Forall2 holds l3 l3' -> Forall2 term_holds (half_terms intervals b w l1 l2 l3) (half_terms reals b w' l1' l2' l3').
Proof. intros; unfold half_terms; hold_all. Qed.

Ltac hold_forms := cbv zeta; repeat lazymatch goal with
  | |- holds (middle_over_r _ _ _ _) _ => apply middle_holds
  | |- Forall2 _ (predicted_terms _ _ _ _ _ _ _ _ _ _ _) _ => apply predicted_terms_hold
  | |- Forall2 _ (turned_back_terms _ _ _ _ _ _ _ _ _) _ => apply turned_back_terms_hold
  | |- Forall2 _ (half_terms _ _ _ _ _ _) _ => apply half_terms_hold
  | |- holds (cosine _ _ _) _ => apply cosine_holds
  | |- Forall2 _ (variable _ _) _ => apply variable_holds
  | |- Forall2 _ (difference _ _ _) _ => apply difference_holds
  | |- Forall2 _ (form_terms _ _ _ _ _ _) _ => apply form_terms_hold
  | |- _ => hold_step end.
Lemma upper_terms_hold : forall e1 e2 x1 x2, holds e1 x1 -> holds e2 x2 ->
  Forall2 term_holds (upper_terms intervals c b e1 e2) (upper_terms reals c b x1 x2).
Proof. intros; unfold upper_terms; hold_forms. Qed.
Lemma lower_terms_hold : forall e1 e2 x1 x2, holds e1 x1 -> holds e2 x2 ->
  Forall2 term_holds (lower_terms intervals c b e1 e2) (lower_terms reals c b x1 x2).
Proof. intros; unfold lower_terms; hold_forms. Qed.
Lemma turned_upper_terms_hold : forall nu g s nu' g' s', holds nu nu' -> holds g g' -> holds s s' ->
  Forall2 term_holds (turned_upper_terms intervals c b nu g s) (turned_upper_terms reals c b nu' g' s').
Proof. intros; unfold turned_upper_terms; hold_forms. Qed.
Lemma turned_lower_terms_hold : forall nu g s nu' g' s', holds nu nu' -> holds g g' -> holds s s' ->
  Forall2 term_holds (turned_lower_terms intervals c b nu g s) (turned_lower_terms reals c b nu' g' s').
Proof. intros; unfold turned_lower_terms; hold_forms. Qed.
Lemma error_terms_hold : forall nu g s nu' g' s', holds nu nu' -> holds g g' -> holds s s' ->
  Forall2 term_holds (error_terms intervals c b nu g s) (error_terms reals c b nu' g' s').
Proof. intros; unfold error_terms; hold_forms. Qed.
End Hold.
Lemma inverse_terms_hold : forall c, Forall2 term_holds (inverse_terms intervals c) (inverse_terms reals c).
Proof. intros; unfold inverse_terms; hold_all. Qed.
