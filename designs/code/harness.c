/* What a certificate is about: the tracker with the gains that ship. */
#include "pll.h"

static pll_t pll;

void setup(void) { pll_init(&pll, 2000.0f, 30000.0f, 1.0f / 12500.0f); }
void step(float alpha, float beta) { pll_run(&pll, alpha, beta); }
float frequency(void) { return pll.speed * pll.dt; }
