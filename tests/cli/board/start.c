/* What a board does before main: memory is set, and the processor's numbers are switched on. */
extern unsigned data_start[], data_end[], data_load[], __bss_start__[], __bss_end__[], stack_top[];
int main(void);
void exit(int status);
void initialise_monitor_handles(void);
void _init(void) {}
void _fini(void) {}

void reset(void) {
  volatile unsigned* const coprocessors = (volatile unsigned*)0xE000ED88;
  unsigned* to;
  const unsigned* from = data_load;
  *coprocessors |= 0xFu << 20;
  __asm volatile("dsb\n isb");
  for (to = data_start; to < data_end; ++to, ++from) *to = *from;
  for (to = __bss_start__; to < __bss_end__; ++to) *to = 0;
  initialise_monitor_handles();
  exit(main());
}

static void fault(void) { exit(1); }

__attribute__((section(".vectors"), used)) static const void* const vectors[] = {
    stack_top, (const void*)reset, (const void*)fault, (const void*)fault};
