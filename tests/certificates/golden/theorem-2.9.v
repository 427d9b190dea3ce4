
(* Everything above is the same for all designs of the kind. *)

(* The design. *)
Definition here : design := {|
  q1 := (23 / 10000); q2 := (23 / 10000); r := (5 / 100);
  state_bound := 7; sigma := (1 / 1000); gamma_fraction := (5 / 10); c1 := 3; c2 := 3 |}.

Lemma printed_epsilon_r_enclosed :
  (70610678118654746 / 100000000000000000) <= epsilon_r printed here <= (70610678118654769 / 100000000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_rho_1_enclosed :
  (15412213562373093 / 1000000000000000) <= rho_1 printed here <= (15412213562373097 / 1000000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_rho_2_enclosed :
  (10898080723049289 / 1000000000000000) <= rho_2 printed here <= (10898080723049296 / 1000000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_b_1_enclosed :
  (19999989999999967 / 1000000000000000000000) <= b_1 printed here <= (19999990000000025 / 1000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_b_2_enclosed :
  (2396607087450304 / 10000000000000) <= b_2 printed here <= (23966070874503058 / 100000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_p_enclosed :
  (50000027300012428 / 1000000000000) <= p printed here <= (50000027300012589 / 1000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_q_enclosed :
  (67444331744068244 / 100000000000000) <= q printed here <= (6744433174406828 / 10000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_s_enclosed :
  (1039511071836133 / 10000000000) <= s printed here <= (10395110718361343 / 100000000000).
Proof.
evaluate here.
Qed.

Lemma printed_gamma_enclosed :
  (19239793304635964 / 10 ^ 31) <= gamma printed here <= (19239793304636119 / 10 ^ 31).
Proof.
evaluate here.
Qed.

Lemma printed_beta_enclosed :
  (5807080530210087 / 1000000000000) <= beta printed here <= (5807080530210099 / 1000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_one_minus_alpha_enclosed :
  (14263462033878111 / 10 ^ 34) <= one_minus_alpha printed here <= (14263462033878237 / 10 ^ 34).
Proof.
evaluate here.
Qed.

Lemma printed_epsilon_z_enclosed :
  (13032266539726057 / 100000000000000000000000000) <= epsilon_z printed here <= (13032266539726133 / 100000000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_delta_p_enclosed :
  (16796363923175569 / 1000000000) <= delta_p printed here <= (16796363923175641 / 1000000000).
Proof.
evaluate here.
Qed.

Lemma printed_delta_k_enclosed :
  (69840058651647775 / 100) <= delta_k printed here <= (69840058651648225 / 100).
Proof.
evaluate here.
Qed.

Lemma printed_delta_k2_enclosed :
  (46922361780384504 * 10000000) <= delta_k2 printed here <= (46922361780385089 * 10000000).
Proof.
evaluate here.
Qed.

Lemma printed_zeta_z_enclosed :
  (14027800066363734 / 10000000000) <= zeta_z printed here <= (14027800066363914 / 10000000000).
Proof.
evaluate here.
Qed.

Lemma printed_eta_enclosed :
  2466413090359086 <= eta printed here <= 2466413090359106.
Proof.
evaluate here.
Qed.

Lemma printed_zeta_enclosed :
  (51064051109092265 * 100000000) <= zeta printed here <= (51064051109092953 * 100000000).
Proof.
evaluate here.
Qed.

Lemma printed_lhs_2_43_enclosed :
  (29653305713248907 * 1000000000000) <= lhs_2_43 printed here <= (29653305713249383 * 1000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_lhs_2_44_enclosed :
  (81460564657060594 / 10000000) <= lhs_2_44 printed here <= (81460564657061825 / 10000000).
Proof.
evaluate here.
Qed.

Lemma printed_initial_error_bound_enclosed :
  (2244202826519878 / 100000000000000000000000000000) <= initial_error_bound printed here <= (22442028265198961 / 1000000000000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma printed_condition_2_43_fails :
  1 <= lhs_2_43 printed here.
Proof.
generalize printed_lhs_2_43_enclosed. generalize (lhs_2_43 printed here). intros constant enclosed.
interval with (i_prec 180).
Qed.

Lemma printed_condition_2_44_fails :
  1 <= lhs_2_44 printed here.
Proof.
generalize printed_lhs_2_44_enclosed. generalize (lhs_2_44 printed here). intros constant enclosed.
interval with (i_prec 180).
Qed.

Lemma printed_condition_2_45_fails :
  initial_error_bound printed here <= sqrt (((5 / 1000) / 1) ^ 2 + 4 * (1 + ((5 / 1000) / 1)) * sin ((5 / 1000) / 2) ^ 2 + (5 / 1000) ^ 2).
Proof.
generalize printed_initial_error_bound_enclosed. generalize (initial_error_bound printed here). intros constant enclosed.
interval with (i_prec 180).
Qed.

Lemma errata_epsilon_r_enclosed :
  (99899999999999999 / 100000000000000000) <= epsilon_r errata here <= (99900000000000012 / 100000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_rho_1_enclosed :
  (15997999999999999 / 1000000000000000) <= rho_1 errata here <= (15998000000000002 / 1000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_rho_2_enclosed :
  (11312294285422385 / 1000000000000000) <= rho_2 errata here <= (1131229428542239 / 100000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_b_1_enclosed :
  (9999999999999995 / 1000000000000000000) <= b_1 errata here <= (10000000000000004 / 1000000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_b_2_enclosed :
  (99999999999999985 / 1000000000000000) <= b_2 errata here <= (10000000000000002 / 100000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_p_enclosed :
  (10000229999999994 / 100000000000000) <= p errata here <= (10000230000000007 / 100000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_q_enclosed :
  (53478260869565201 / 100000000000000) <= q errata here <= (53478260869565225 / 100000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_s_enclosed :
  (11181130608695647 / 100000000000) <= s errata here <= (11181130608695657 / 100000000000).
Proof.
evaluate here.
Qed.

Lemma errata_gamma_enclosed :
  (44716139922794458 / 100000000000000000000000000) <= gamma errata here <= (44716139922794614 / 100000000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_beta_enclosed :
  (23125633152319346 / 100000000000000) <= beta errata here <= (2312563315231937 / 10000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_one_minus_alpha_enclosed :
  (4180777309855639 / 10000000000000000000000000000) <= one_minus_alpha errata here <= (41807773098556573 / 100000000000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_epsilon_z_enclosed :
  (67972825326368434 / 1000000000000000000000000) <= epsilon_z errata here <= (6797282532636866 / 100000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_delta_p_enclosed :
  (3619564927642374 / 100000000000) <= delta_p errata here <= (36195649276423814 / 1000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_delta_k_enclosed :
  (16188338520179206 / 10000) <= delta_k errata here <= (16188338520179268 / 10000).
Proof.
evaluate here.
Qed.

Lemma errata_delta_k2_enclosed :
  (23437924572999521 * 100) <= delta_k2 errata here <= (23437924572999706 * 100).
Proof.
evaluate here.
Qed.

Lemma errata_zeta_z_enclosed :
  (1760367297068709 / 1000000000) <= zeta_z errata here <= (17603672970687224 / 10000000000).
Proof.
evaluate here.
Qed.

Lemma errata_eta_enclosed :
  (10456917002946708 / 1000) <= eta errata here <= (10456917002946762 / 1000).
Proof.
evaluate here.
Qed.

Lemma errata_zeta_enclosed :
  (37458547536360669 * 1000) <= zeta errata here <= (37458547536360989 * 1000).
Proof.
evaluate here.
Qed.

Lemma errata_lhs_2_43_enclosed :
  (86625287056741892 * 100000) <= lhs_2_43 errata here <= (86625287056742752 * 100000).
Proof.
evaluate here.
Qed.

Lemma errata_lhs_2_44_enclosed :
  (40709608425350928 / 100000000) <= lhs_2_44 errata here <= (40709608425351286 / 100000000).
Proof.
evaluate here.
Qed.

Lemma errata_initial_error_bound_enclosed :
  (29392849431908911 / 100000000000000000000000000) <= initial_error_bound errata here <= (29392849431909047 / 100000000000000000000000000).
Proof.
evaluate here.
Qed.

Lemma errata_condition_2_43_fails :
  1 <= lhs_2_43 errata here.
Proof.
generalize errata_lhs_2_43_enclosed. generalize (lhs_2_43 errata here). intros constant enclosed.
interval with (i_prec 180).
Qed.

Lemma errata_condition_2_44_fails :
  1 <= lhs_2_44 errata here.
Proof.
generalize errata_lhs_2_44_enclosed. generalize (lhs_2_44 errata here). intros constant enclosed.
interval with (i_prec 180).
Qed.

Lemma errata_condition_2_45_fails :
  initial_error_bound errata here <= sqrt (((5 / 1000) / 1) ^ 2 + 4 * (1 + ((5 / 1000) / 1)) * sin ((5 / 1000) / 2) ^ 2 + (5 / 1000) ^ 2).
Proof.
generalize errata_initial_error_bound_enclosed. generalize (initial_error_bound errata here). intros constant enclosed.
interval with (i_prec 180).
Qed.

(* The statements that certificate.md lists as proved here, and their axioms. *)
Definition proved_here := (
  condition_2_43_fails_for_every_design,
  condition_2_43_fails_for_every_design,
  printed_epsilon_r_enclosed,
  printed_rho_1_enclosed,
  printed_rho_2_enclosed,
  printed_b_1_enclosed,
  printed_b_2_enclosed,
  printed_p_enclosed,
  printed_q_enclosed,
  printed_s_enclosed,
  printed_gamma_enclosed,
  printed_beta_enclosed,
  printed_one_minus_alpha_enclosed,
  printed_epsilon_z_enclosed,
  printed_delta_p_enclosed,
  printed_delta_k_enclosed,
  printed_delta_k2_enclosed,
  printed_zeta_z_enclosed,
  printed_eta_enclosed,
  printed_zeta_enclosed,
  printed_lhs_2_43_enclosed,
  printed_lhs_2_44_enclosed,
  printed_initial_error_bound_enclosed,
  printed_condition_2_43_fails,
  printed_condition_2_44_fails,
  printed_condition_2_45_fails,
  errata_epsilon_r_enclosed,
  errata_rho_1_enclosed,
  errata_rho_2_enclosed,
  errata_b_1_enclosed,
  errata_b_2_enclosed,
  errata_p_enclosed,
  errata_q_enclosed,
  errata_s_enclosed,
  errata_gamma_enclosed,
  errata_beta_enclosed,
  errata_one_minus_alpha_enclosed,
  errata_epsilon_z_enclosed,
  errata_delta_p_enclosed,
  errata_delta_k_enclosed,
  errata_delta_k2_enclosed,
  errata_zeta_z_enclosed,
  errata_eta_enclosed,
  errata_zeta_enclosed,
  errata_lhs_2_43_enclosed,
  errata_lhs_2_44_enclosed,
  errata_initial_error_bound_enclosed,
  errata_condition_2_43_fails,
  errata_condition_2_44_fails,
  errata_condition_2_45_fails).
Print Assumptions proved_here.
