// The angle tracker of a motor: back EMF of two axes in, an angle that is wrapped by loops, a guard against
// samples that are no numbers.
#include <math.h>
#include <stdint.h>

#define TURN 6.2831853f

typedef struct {
  float kp, ki, dt;
  float speed_limit;
} motor_config_t;

typedef struct {
  const motor_config_t* config;
  float angle;
  float speed;  // rad/s
  float amplitude;
  uint32_t rejected;
} motor_pll_t;

static const motor_config_t kConfig = {200.0f, 1e4f, 1e-3f, 900.0f};
motor_pll_t motor;

static void motor_pll_init(motor_pll_t* pll, const motor_config_t* config) {
  pll->config = config;
  pll->angle = 0.0f;
  pll->speed = 300.0f;
  pll->amplitude = 1.0f;
}

static float wrapped(float angle) {
  while (angle > TURN / 2) {
    angle -= TURN;
  }
  while (angle < -TURN / 2) {
    angle += TURN;
  }
  return angle;
}

static void motor_pll_run(motor_pll_t* pll, float a, float b) {
  if (isnan(a) || isnan(b)) {
    ++pll->rejected;
    return;
  }
  const motor_config_t* c = pll->config;
  const float e = b * cosf(pll->angle) - a * sinf(pll->angle);
  pll->amplitude += 0.01f * (sqrtf(a * a + b * b) - pll->amplitude);
  pll->speed += c->ki * c->dt * e;
  if (pll->speed > c->speed_limit) {
    pll->speed = c->speed_limit;
  } else if (pll->speed < -c->speed_limit) {
    pll->speed = -c->speed_limit;
  }
  pll->angle = wrapped(pll->angle + (pll->speed + c->kp * e) * c->dt);
}

void setup(void) {
  motor_pll_init(&motor, &kConfig);
}
void step(float a, float b) {
  motor_pll_run(&motor, a, b);
}
float frequency(void) {
  return motor.speed * motor.config->dt;
}
