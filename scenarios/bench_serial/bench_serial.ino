// A bench for `mckibben control --device serial`: encoder and valve on a microcontroller (Arduino and alike).
// docs/control.md says which lines go to and fro. Change what stands between the lines of signs to your wiring.
//
// It vents by itself: when it starts, and after ten ticks without a line.

// --------------------------------------------------------------------------------------------------------
const int channel_a = 2, channel_b = 3;  // of the encoder; pins that can interrupt
const int output = DAC0;                 // drives a 0 to 20 mA stage: 0 V is 0 mA, full scale is 20 mA
const int output_bits = 12;
const char unit[] = "mA";                // what your valve takes: mA, V or bar
const float largest_command = 20.0;      // in that unit, at full scale

void begin_output() { analogWriteResolution(output_bits); }
void put(float command) {
  const long top = (1L << output_bits) - 1;
  analogWrite(output, constrain(lround(command / largest_command * top), 0L, top));
}
// --------------------------------------------------------------------------------------------------------

volatile long counts = 0;
unsigned long heard_ms = 0, patience_ms = 120;
char line[32];
unsigned int length = 0;

// A rising edge of A, B gives the direction.
void edge_of_a() { counts += digitalRead(channel_b) == HIGH ? 1 : -1; }

long counts_now() {
  noInterrupts();
  const long now = counts;
  interrupts();
  return now;
}

void answer(const char* text) {
  long tick_ms = 0;
  int version = 0;
  char wanted[8] = "mA";
  if (sscanf(text, "mckibben %d %ld %7s", &version, &tick_ms, wanted) >= 2) {
    if (strcmp(wanted, unit) != 0) return;  // commands for another valve
    patience_ms = 10 * tick_ms;
    noInterrupts();
    counts = 0;
    interrupts();
    Serial.println(version == 2 ? "ready 2" : "ready 1");
  } else if (text[0] == '?') {
    Serial.println(counts_now());
  } else if (text[0] == '=') {
    put(atof(text + 1));
  }
}

void setup() {
  begin_output();
  put(0.0);
  pinMode(channel_a, INPUT_PULLUP);
  pinMode(channel_b, INPUT_PULLUP);
  attachInterrupt(digitalPinToInterrupt(channel_a), edge_of_a, RISING);
  Serial.begin(115200);
}

void loop() {
  while (Serial.available() > 0) {
    const char c = Serial.read();
    if (c == '\n') {
      line[length] = '\0';
      length = 0;
      heard_ms = millis();
      answer(line);
    } else if (length + 1 < sizeof line) {
      line[length++] = c;
    }
  }
  if (millis() - heard_ms > patience_ms) put(0.0);
}
