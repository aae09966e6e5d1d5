% A PI controller in a process of its own, for Octave: octave-cli --quiet --norc controller.m
% docs/your_controller.md says which lines go to and fro.
1;
% fgetl would wait for the first character after the line.
function text = next_line()
  text = "";
  while true
    character = fread(stdin, 1, "uint8=>char");
    if isempty(character)
      text = -1;
      return
    elseif character == "\n"
      return
    end
    text(end + 1) = character;
  end
end

gain_mA = 30.0;
integral_time_s = 0.3;

hello = jsondecode(next_line());
assert(hello.mckibben_controller == 1);
integral_mA = hello.lowest_mA;
printf("%.17g\n", integral_mA);  % while the rig settles
fflush(stdout);

while ischar(line = next_line())
  now = jsondecode(line);
  ratio = (now.counts + hello.middle_of_count) * hello.contraction_per_count;
  error_ratio = now.target - ratio;
  wanted_mA = integral_mA + gain_mA * error_ratio;
  current_mA = min(max(wanted_mA, hello.lowest_mA), hello.highest_mA);
  if current_mA == wanted_mA  % at a limit the integral waits
    integral_mA = integral_mA + gain_mA * hello.period_s / integral_time_s * error_ratio;
  end
  printf("%.17g\n", current_mA);
  fflush(stdout);
end
