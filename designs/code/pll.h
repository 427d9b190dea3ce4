#include <stdbool.h>

typedef struct {
  float phase, speed; /* rad, rad/s */
  float kp, ki, dt;
  bool ready;
  unsigned samples;
} pll_t;

void pll_init(pll_t* pll, float kp, float ki, float dt);
void pll_run(pll_t* pll, float alpha, float beta);
