From Coq Require Import Reals.
Local Open Scope R_scope.

(* The extended Kalman filter of B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis,
   Australian National University, 1994, chapter 3, without a leak, over the real numbers. Equation numbers are the
   thesis's. This page and the theorem at the end of the file are all that has to be read. *)

(* Matrices: entry (i, j) of A is A i j, counted from 1; a vector is a matrix with one column. *)
Definition matrix (rows columns : nat) := nat -> nat -> R.

Fixpoint sum (n : nat) (f : nat -> R) : R :=
  match n with O => 0 | S m => sum m f + f n end.
Definition times {l m n : nat} (A : matrix l m) (B : matrix m n) : matrix l n :=
  fun i j => sum m (fun k => A i k * B k j).
Definition plus {m n : nat} (A B : matrix m n) : matrix m n := fun i j => A i j + B i j.
Definition minus {m n : nat} (A B : matrix m n) : matrix m n := fun i j => A i j - B i j.
Definition transpose {m n : nat} (A : matrix m n) : matrix n m := fun i j => A j i.
Definition matrix_3_3 (a b c d e f g h k : R) : matrix 3 3 := fun i j =>
  match i, j with
  | 1, 1 => a | 1, 2 => b | 1, 3 => c
  | 2, 1 => d | 2, 2 => e | 2, 3 => f
  | 3, 1 => g | 3, 2 => h | 3, 3 => k
  | _, _ => 0%R end%nat.
Definition vector_3 (a b c : R) : matrix 3 1 := fun i _ =>
  match i with 1 => a | 2 => b | 3 => c | _ => 0%R end%nat.
Definition vector_2 (a b : R) : matrix 2 1 := fun i _ => match i with 1 => a | 2 => b | _ => 0%R end%nat.
Definition inverse_2_2 (A : matrix 2 2) : matrix 2 2 := fun i j =>
  let '(a, b, c, d) := (A 1%nat 1%nat, A 1%nat 2%nat, A 2%nat 1%nat, A 2%nat 2%nat) in
  match i, j with
  | 1, 1 => (d / (a * d - b * c))%R | 1, 2 => (- b / (a * d - b * c))%R
  | 2, 1 => (- c / (a * d - b * c))%R | 2, 2 => (a / (a * d - b * c))%R
  | _, _ => 0%R end%nat.

Declare Scope matrix_scope.
Infix "*" := times : matrix_scope.
Infix "+" := plus : matrix_scope.
Infix "-" := minus : matrix_scope.
Notation "A '^T'" := (transpose A) (at level 8) : matrix_scope.
Delimit Scope matrix_scope with matrix.

(* What the filter is designed with: Q = diag(q1, q1, q2) (Q_x) and R = r I (R_y). *)
Record noise_model := { q1 : R; q2 : R; r : R }.

(* The estimate x = (x1, x2, x3), in-phase and quadrature part and frequency in rad/sample, and its covariance P. *)
Record estimate := { x : matrix 3 1; P : matrix 3 3 }.

Section Filter.
Variable design : noise_model.

Definition Q_x : matrix 3 3 := matrix_3_3 (q1 design) 0 0 0 (q1 design) 0 0 0 (q2 design).
Definition R_y : matrix 2 2 := fun i j => if Nat.eqb i j then r design else 0.
(* (3.9), that is (2.9) *)
Definition H : matrix 2 3 := fun i j => if Nat.eqb i j then 1 else 0.
(* (3.1) with epsilon = 0: the phasor turns by the frequency. *)
Definition f (x : matrix 3 1) : matrix 3 1 :=
  let '(x1, x2, x3) := (x 1%nat 1%nat, x 2%nat 1%nat, x 3%nat 1%nat) in
  vector_3 (cos x3 * x1 - sin x3 * x2) (sin x3 * x1 + cos x3 * x2) x3.
(* (3.8), that is (2.8): its derivative. *)
Definition F (x : matrix 3 1) : matrix 3 3 :=
  let '(x1, x2, x3) := (x 1%nat 1%nat, x 2%nat 1%nat, x 3%nat 1%nat) in
  matrix_3_3 (cos x3) (- sin x3) (- sin x3 * x1 - cos x3 * x2)
             (sin x3) (cos x3)   (cos x3 * x1 - sin x3 * x2)
             0        0          1.

(* (2.5), (2.6) *)
Definition time_update (s : estimate) : estimate :=
  {| x := f (x s); P := (F (x s) * P s * (F (x s))^T + Q_x)%matrix |}.
(* (2.7), the gain *)
Definition gain (P : matrix 3 3) : matrix 3 2 := (P * H^T * inverse_2_2 (H * P * H^T + R_y))%matrix.
(* (2.3), (2.4) *)
Definition measurement_update (s : estimate) (y : matrix 2 1) : estimate :=
  let K := gain (P s) in
  {| x := (x s + K * (y - H * x s))%matrix; P := (P s - K * H * P s)%matrix |}.

Definition step (s : estimate) (y : matrix 2 1) : estimate := measurement_update (time_update s) y.

(* The estimate after sample k, from the estimate `start` of sample 0 and the measurements y(1), y(2), ... *)
Fixpoint run (start : estimate) (y : nat -> matrix 2 1) (k : nat) : estimate :=
  match k with O => start | S j => step (run start y j) (y (S j)) end.
End Filter.

(* (3.2). The signal: a tone of amplitude 1 with the phase phi(k), phi(k+1) = phi(k) + omega(k), which is (3.1) for
   x = (cos phi, sin phi, omega), measured with the noise (v1, v2). *)
Definition measurement (phi v1 v2 : nat -> R) (k : nat) : matrix 2 1 :=
  vector_2 (cos (phi k) + v1 k) (sin (phi k) + v2 k).

(* Symmetric matrices, their forms and their (Loewner) order. *)
Record symmetric := Symmetric { s11 : R; s12 : R; s13 : R; s22 : R; s23 : R; s33 : R }.
Definition full (m : symmetric) : matrix 3 3 :=
  matrix_3_3 (s11 m) (s12 m) (s13 m) (s12 m) (s22 m) (s23 m) (s13 m) (s23 m) (s33 m).
Definition form (m : symmetric) (a b c : R) : R :=
  s11 m * a * a + s22 m * b * b + s33 m * c * c + 2 * (s12 m * a * b + s13 m * a * c + s23 m * b * c).
Definition below (l m : symmetric) : Prop := forall a b c, form l a b c <= form m a b c.
Definition multiple (k : R) (m : symmetric) : symmetric :=
  Symmetric (k * s11 m) (k * s12 m) (k * s13 m) (k * s22 m) (k * s23 m) (k * s33 m).

(* The turn of the plane by an angle. *)
Definition turn (angle : R) : matrix 3 3 :=
  matrix_3_3 (cos angle) (- sin angle) 0 (sin angle) (cos angle) 0 0 0 1.

(* A start at the true phase phi and the true frequency omega: amplitude 1 + a, phase error psi, frequency error nu, and
   the covariance m in the frame of the estimated phase. *)
Definition start_estimate (phi omega a psi nu : R) (m : symmetric) : estimate :=
  {| x := vector_3 ((1 + a) * cos (phi + psi)) ((1 + a) * sin (phi + psi)) (omega + nu);
     P := (turn (phi + psi) * full m * (turn (phi + psi))^T)%matrix |}.

(* P*: the covariance that the filter keeps on a tone that it follows without error (of frequency 0 and phase 0; by
   symmetry the frame of the estimated phase keeps it at every frequency). *)
Definition is_steady (design : noise_model) (m : symmetric) : Prop :=
  (forall a b c, 0 <= form m a b c) /\
  forall i j, (1 <= i <= 3)%nat -> (1 <= j <= 3)%nat ->
    P (step design {| x := vector_3 1 0 0; P := full m |} (vector_2 1 0)) i j = full m i j.
