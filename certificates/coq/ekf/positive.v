From Coq Require Import Reals Lra Psatz QArith Qreals List.
From Interval Require Import Specific_ops Specific_stdz Interval Float_full Xreal.
Import ListNotations.
Local Open Scope R_scope.

(* Intervals with ends m 2^e, m and e Coq's own integers: they need no axiom beyond those of the real numbers. *)
Module Floats := SpecificFloat StdZRadix2.
Module I := FloatIntervalFull Floats.
Definition precision := I.F.PtoP 40%positive.

(* A scalar that formulas are written for: real numbers, or intervals (None is exactly 0, for speed). *)
Record scalar (T : Type) := { zero : T; number : Q -> T; add : T -> T -> T; negate : T -> T; multiply : T -> T -> T }.
Arguments zero {T}. Arguments number {T}. Arguments add {T}. Arguments negate {T}. Arguments multiply {T}.

Definition reals : scalar R := {| zero := 0; number := Q2R; add := Rplus; negate := Ropp; multiply := Rmult |}.

Definition interval := option I.type.
Definition interval_number (q : Q) : interval :=
  if Qeq_bool q 0 then None else
    Some (I.div precision (I.fromZ precision (Qnum q)) (I.fromZ precision (Zpos (Qden q)))).
Definition interval_add (a b : interval) : interval :=
  match a, b with None, _ => b | _, None => a | Some i, Some j => Some (I.add precision i j) end.
Definition interval_multiply (a b : interval) : interval :=
  match a, b with Some i, Some j => Some (I.mul precision i j) | _, _ => None end.
Definition intervals : scalar interval := {|
  zero := None; number := interval_number; add := interval_add; negate := option_map I.neg;
  multiply := interval_multiply |}.

Definition holds (a : interval) (x : R) : Prop :=
  match a with None => x = 0 | Some i => contains (I.convert i) (Xreal x) end.

Lemma number_holds : forall q, holds (interval_number q) (Q2R q).
Proof.
  intro q; unfold interval_number; destruct (Qeq_bool q 0) eqn:E; unfold holds.
  - apply Qeq_bool_eq, Qeq_eqR in E; rewrite E; unfold Q2R; simpl; lra.
  - unfold Q2R.
    replace (Xreal (IZR (Qnum q) * / IZR (Zpos (Qden q)))) with
      (Xdiv (Xreal (IZR (Qnum q))) (Xreal (IZR (Zpos (Qden q))))).
    + apply (I.div_correct precision); apply I.fromZ_correct.
    + unfold Xdiv, Xdiv'; rewrite is_zero_false; [reflexivity | apply not_0_IZR; discriminate].
Qed.

Lemma add_holds : forall a b x y, holds a x -> holds b y -> holds (interval_add a b) (x + y).
Proof.
  intros [i |] [j |] x y A B; simpl in *; subst; rewrite ?Rplus_0_l, ?Rplus_0_r; try assumption; try reflexivity.
  exact (I.add_correct precision i j (Xreal x) (Xreal y) A B).
Qed.

Lemma negate_holds : forall a x, holds a x -> holds (option_map I.neg a) (- x).
Proof.
  intros [i |] x A; simpl in *; [exact (I.neg_correct i (Xreal x) A) | subst; ring].
Qed.

Lemma multiply_holds : forall a b x y, holds a x -> holds b y -> holds (interval_multiply a b) (x * y).
Proof.
  intros [i |] [j |] x y A B; simpl in *; subst; rewrite ?Rmult_0_l, ?Rmult_0_r; try reflexivity.
  exact (I.mul_correct precision i j (Xreal x) (Xreal y) A B).
Qed.

(* Linear forms are lists of coefficients, quadratic forms are lists of terms weight * linear * linear. *)
Section Forms.
Context {T : Type}.
Variable ops : scalar T.

Definition scaled (a : T) (l : list T) : list T := map (multiply ops a) l.
Fixpoint added (l m : list T) : list T :=
  match l, m with [], _ => m | _, [] => l | a :: l', b :: m' => add ops a b :: added l' m' end.
Definition head (l : list T) : T := match l with [] => zero ops | a :: _ => a end.
Definition term : Type := T * list T * list T.
Definition tails (t : term) : term := let '(w, l, m) := t in (w, tl l, tl m).
(* The coefficients of the first variable's square, and of its products with the others. *)
Fixpoint square_coefficient (terms : list term) : T :=
  match terms with
  | [] => zero ops
  | (w, l, m) :: rest => add ops (multiply ops w (multiply ops (head l) (head m))) (square_coefficient rest) end.
Fixpoint product_coefficients (terms : list term) : list T :=
  match terms with
  | [] => []
  | (w, l, m) :: rest =>
      added (added (scaled (multiply ops w (head l)) (tl m)) (scaled (multiply ops w (head m)) (tl l)))
            (product_coefficients rest) end.
End Forms.

Fixpoint dot (l x : list R) : R := match l, x with a :: l', y :: x' => a * y + dot l' x' | _, _ => 0 end.
Fixpoint value (terms : list (@term R)) (x : list R) : R :=
  match terms with [] => 0 | (w, l, m) :: rest => w * (dot l x * dot m x) + value rest x end.

(* Is the form positive? The first variable is eliminated: c y^2 + y (o x) = c (y + o x / (2 c))^2 - (o x)^2 / (4 c). *)
Fixpoint positive (variables : nat) (terms : list (@term interval)) : bool :=
  match variables with
  | O => true
  | S n => match square_coefficient intervals terms with
           | Some c => match I.sign_strict c with
                       | Xgt => let o := product_coefficients intervals terms in
                                let w := I.neg (I.inv precision (I.mul precision (I.fromZ precision 4) c)) in
                                positive n ((Some w, o, o) :: map tails terms)
                       | _ => false end
           | None => false end end.

Definition term_holds (a : @term interval) (x : @term R) : Prop :=
  let '(w, l, m) := a in let '(w', l', m') := x in holds w w' /\ Forall2 holds l l' /\ Forall2 holds m m'.

Lemma dot_added : forall l m x, dot (added reals l m) x = dot l x + dot m x.
Proof.
  induction l as [| a l IH]; intros [| b m] [| y x]; simpl; try ring; rewrite ?IH; ring.
Qed.
Lemma dot_scaled : forall a l x, dot (scaled reals a l) x = a * dot l x.
Proof. induction l as [| b l IH]; intros [| y x]; simpl; rewrite ?IH; ring. Qed.

Lemma added_holds : forall l m x y, Forall2 holds l x -> Forall2 holds m y ->
  Forall2 holds (added intervals l m) (added reals x y).
Proof.
  intros l m x y A; revert m y; induction A as [| a b l x ab A IH]; intros m y B; [exact B |].
  destruct B as [| c e m y ce B]; simpl; constructor; auto. apply add_holds; assumption.
Qed.
Lemma scaled_holds : forall a l x y, holds a x -> Forall2 holds l y -> Forall2 holds (scaled intervals a l) (scaled reals x y).
Proof. intros a l x y A B; induction B; simpl; constructor; auto; apply multiply_holds; assumption. Qed.
Lemma head_holds : forall l x, Forall2 holds l x -> holds (head intervals l) (head reals x).
Proof. intros l x [| a b l' x' A B]; simpl; auto. Qed.
Lemma tl_holds : forall l x, Forall2 holds l x -> Forall2 holds (tl l) (tl x).
Proof. intros l x [| a b l' x' A B]; simpl; auto. Qed.

Lemma square_holds : forall terms x, Forall2 term_holds terms x ->
  holds (square_coefficient intervals terms) (square_coefficient reals x).
Proof.
  intros terms x A; induction A as [| [[w l] m] [[w' l'] m'] terms x [B [C D]] A IH]; [reflexivity |].
  apply add_holds; [| exact IH]; apply multiply_holds; [exact B |].
  apply multiply_holds; apply head_holds; assumption.
Qed.
Lemma products_hold : forall terms x, Forall2 term_holds terms x ->
  Forall2 holds (product_coefficients intervals terms) (product_coefficients reals x).
Proof.
  intros terms x A; induction A as [| [[w l] m] [[w' l'] m'] terms x [B [C D]] A IH]; [constructor |].
  simpl; apply added_holds; [| exact IH].
  apply added_holds; apply scaled_holds; try apply tl_holds; try assumption;
    apply multiply_holds; try apply head_holds; assumption.
Qed.

Lemma dot_cons : forall l y x, dot l (y :: x) = head reals l * y + dot (tl l) x.
Proof. intros [| a l] y x; simpl; [destruct x; simpl; ring | reflexivity]. Qed.
Lemma value_cons : forall terms y x, value terms (y :: x) =
  square_coefficient reals terms * (y * y) + y * dot (product_coefficients reals terms) x + value (map tails terms) x.
Proof.
  induction terms as [| [[w l] m] rest IH]; intros y x; simpl; [destruct x; simpl; ring |].
  rewrite IH, !dot_cons, !dot_added, !dot_scaled; simpl; ring.
Qed.

Theorem positive_sound : forall n terms x y, Forall2 term_holds terms x -> length y = n -> positive n terms = true ->
  0 <= value x y.
Proof.
  induction n as [| n IH]; intros terms x y A size check.
  - destruct y; [| discriminate]; clear A check.
    induction x as [| [[w l] m] rest IHx]; simpl; [lra |].
    destruct l, m; simpl; lra.
  - destruct y as [| y ys]; [discriminate |]; cbn [positive] in check.
    pose proof (square_holds _ _ A) as square; pose proof (products_hold _ _ A) as products.
    destruct (square_coefficient intervals terms) as [c |]; [| discriminate].
    destruct (I.sign_strict c) eqn:sign; try discriminate.
    pose proof (I.sign_strict_correct c) as sign_correct; rewrite sign in sign_correct.
    destruct (sign_correct _ square) as [_ positive_c]; simpl in positive_c.
    rewrite value_cons; set (c' := square_coefficient reals x) in *; set (o := product_coefficients reals x) in *.
    assert (rest : 0 <= value ((- / (4 * c'), o, o) :: map tails x) ys).
    { refine (IH _ _ ys _ _ check); [| simpl in size; lia].
      constructor; [split; [| split; exact products] |].
      - unfold holds; replace (Xreal (- / (4 * c'))) with (Xneg (Xinv (Xmul (Xreal 4) (Xreal c')))).
        + apply I.neg_correct, (I.inv_correct precision), (I.mul_correct precision);
            [apply (I.fromZ_correct precision 4) | exact square].
        + cbn; unfold Xinv'; rewrite is_zero_false; [reflexivity | lra].
      - clear - A; induction A as [| [[w l] m] [[w' l'] m'] terms x [B [C D]] A IH]; constructor; [| exact IH].
        simpl; repeat split; try apply tl_holds; assumption. }
    simpl in rest; set (d := dot o ys) in *.
    replace (c' * (y * y) + y * d + value (map tails x) ys) with
      (c' * ((y + d / (2 * c')) * (y + d / (2 * c'))) + (- / (4 * c') * (d * d) + value (map tails x) ys)) by (field; lra).
    pose proof (Rle_0_sqr (y + d / (2 * c'))) as s; unfold Rsqr in s; nra.
Qed.
