Events of a typed equation
==========================

  $ integrate() { integrators integrate --equation "$@"; }

A ball falls 20 m in sqrt(2 20/9.81) s, the root of a parabola:

  $ for method in series ode45 "rk4 --step 0.1" adaptive-collocation; do
  >   integrate "x'' = -9.81; x(0) = 20; x'(0) = 0" --until 10 --event "x=0 end" --method $method > fall.csv
  >   cut -d, -f 4 fall.csv | paste -s -d '|'
  >   holds 'n = 1' 'T := sqrt(40/9.81)' 't = T +- 1e-8*T' 'x = 0 +- 2e-7' "x' = -9.81*T +- 1e-7" < fall.csv
  > done
  event||x=0
  event||x=0
  event||x=0
  event||x=0

Their rows stand in order among the others; a comma may stand in the text of an event:

  $ integrate "x'' = -x" --initial "x=0, x'=1" --until 7 --every 2 --event "x=0 falling" "x'=0" > rows.csv
  $ holds --each 't = [0, pi/2, 2, pi, 4, 3*pi/2, 6, 7] +- 4e-9' < rows.csv
  $ cut -d, -f 4 rows.csv | paste -s -d '|'
  event||x'=0||x=0 falling||x'=0||

tan has poles between its zeros, and atan2 jumps from pi to -pi: neither is an event. With x = cos(t), x' = -sin(t) their angle, pi/2 + t,
is 1 at 3 pi/2 + 1:

  $ swing() { integrate "x'' = -x" --initial "x=1, x'=0" --until 10 --event "$1"; }
  $ swing 'tan(t)=0' | holds --where 'event=tan(t)=0' 't = [pi, 2*pi, 3*pi] +- 1e-12'
  $ swing '1/x=0' | cut -d, -f 4 | paste -s -d '|'
  event||
  $ swing "atan2(x,x')=1" > angle.csv
  $ holds --where "event=atan2(x,x')=1" 't = [3*pi/2 + 1] +- 1e-8' < angle.csv

So it is for functions of the state, and for those that jump between two zeros, here from 2 to -2:

  $ steady() { integrate "x' = 1" --initial x=0 --until 10 --event "$1"; }
  $ steady 'tan(x)=0' | holds --where 'event=tan(x)=0' 't = [pi, 2*pi, 3*pi] +- 1e-12'
  $ steady 'if(x < 3, x - 1, x - 5)=0' > jump.csv
  $ holds --where 'event=if(x < 3, x - 1, x - 5)=0' 't = [1, 5] +- 1e-12' < jump.csv
  $ steady 'mod(t, 1)=0.25' | holds --where 'event=mod(t, 1)=0.25' 't = i + 0.25 +- 1e-12' 'n = 10'
  $ steady 'floor(t)=3' > rows.csv
  integrators: floor(t)=3 stays at zero from t = 3 to 4

A function that only tends to zero ends nothing and changes nothing, and where bounds are wide near a point without a value there is no event:

  $ integrate "v' = 9.81 - 0.5 v; v(0) = 0" --until 100 --event "terminal: v=19.62 end" 2>/dev/null | holds --where t=100 'v = 19.62 +- 1e-7'
  $ integrate "x' = 1 - x; x(0) = 0" --until 50 --event "s: x=1" --set-at "s: x=0" 2>/dev/null | holds --where t=50 'x = 1 +- 1e-7'
  $ for f in '(exp(x)-1)/x=0.5' 'sin(x)/x=0' 'x/sin(x)=0'; do
  >   integrate "x' = 1; x(0) = -1" --until 3 --event "$f end" 2>/dev/null | tail -1
  > done
  3,2,
  3,2,
  3,2,

One that stays at zero has one row, when it comes there, and none when it leaves; the errors of h allow the root of 1e-8 in time:

  $ integrate "h' = -0.1 sqrt(h) + if(t > 25, 0.05, 0); h(0) = 1" --until 60 --event "h=0" 2>/dev/null | holds --where event=h=0 'n = 1' 't = 20 +- 1e-3'
  $ integrate "h' = -sqrt(h); h(0) = 1" --until 7 --event "refill: h=0" --set-at "refill: h=1" 2>/dev/null | holds --where event=refill 't = [2, 4, 6] +- 1e-3'
  $ integrate "y'' = -9.81; y(0) = 1; y'(0) = 0" --until 9 --event "b: y=0 falling end after 2" --set-at "b: y' = -0.8 y'" | holds 't = 2.6*sqrt(2/9.81) +- 1e-8'

A section shows its own rows alone:

  $ integrate "x'' = -x" --initial "x=0, x'=1" --until 20 --section "x=0 rising" --tolerance 1e-13 |
  >   holds --each 't = [2*pi, 4*pi, 6*pi] +- 1e-12'

Every zero
----------

One step of a parabola is exact, however long it is; its events are found all the same, and pulses of time however narrow:

  $ integrate "x' = 1" --initial x=0 --until 100 --event "sin(t)=0" | holds --where 'event=sin(t)=0' 'n = 31' 't = pi*(i + 1) +- 1e-12'
  $ integrate "x'' = -9.81" --initial "x=0, x'=0" --until 10 --event "sin(20 t)=0" | holds --where 'event=sin(20 t)=0' 'n = 63' 't = pi*(i + 1)/20 +- 1e-12'
  $ integrate "x' = 1" --initial x=0 --until 100 --event "exp(-((t - 50)/1e-6)^2) = 0.5" |
  >   holds --where 'event=exp(-((t - 50)/1e-6)^2) = 0.5' 't = 50 + (2*i - 1)*1e-6*sqrt(log(2)) +- 2e-14'
  $ integrate "x'' = -x" --initial "x=1, x'=0" --until 100 --event "x=0.99999" | holds --where 'event=x=0.99999' 'n = 31'
  $ integrate "x'' = -x" --initial "x=1, x'=0" --until 100 --event "x x' = 0.4999" | holds --where "event=x x' = 0.4999" 'n = 64'

Double zeros are rows, and standard error says that rounding decides about them:

  $ swing() { integrate "x'' = -x" --initial "x=1, x'=0" --until 10 --event "$@"; }
  $ swing "x^2=0" | holds --where 'event=x^2=0' 'n = 3' 't = pi*(i + 0.5) +- 1e-8'
  integrators: x^2=0 touches zero 3 times to within the tolerance, first at t = 1.57079633: it may cross zero twice there or not reach it
  $ swing "x=1" | holds --where 'event=x=1' 'n = 1' 't = 2*pi +- 1e-8'
  integrators: x=1 touches zero 1 times to within the tolerance, first at t = 6.28318531: it may cross zero twice there or not reach it
  $ for touch in "(t - 7)^2" "abs(t - 7)" "(t - 7)^4"; do
  >   swing "touch: $touch" 2> words | holds --where event=touch 'n = 1' 't = 7 +- 1e-14'
  >   grep -c "touches zero 1 times" words
  > done
  1
  1
  1
  $ swing "x^2 + x'^2 = 2 x^2 + 2 x'^2 - 1" > /dev/null
  integrators: * cannot be distinguished from zero between t = * (glob)

An event that is zero throughout has no row, and is named:

  $ integrate "x' = -x" --initial x=0 --until 5 --event x=0
  integrators: x=0 cannot be distinguished from zero between t = 0 and 5: rows may be missing, and those there may be none
  t,x,event
  0,0,
  5,0,

One that comes to rest at zero has a row, and may end the run there:

  $ tank() { integrate "h' = -sqrt(h)" --initial h=1 --until 3 "$@"; }
  $ tank --event "empty: h=0" > rows.csv
  integrators: empty stays at zero from t = 2.0* to 3 (glob)
  $ holds --where event=empty 'n = 1' 't = 2 +- 5e-4' 'h = 0' < rows.csv
  $ tank --event "empty: h=0 falling end" 2> said.txt | holds 't = 2 +- 5e-4' 'h = 0'

Also where it jumps there, or reaches it at a corner:

  $ for rest in "floor(x) = 2" "max(2 - x, 0)" "if(t < 2, 1, 0)" "min(t - 2, 0)"; do
  >   steady "rest: $rest end" 2> words | holds 't = 2 +- 1e-7'
  >   grep -c "rest stays at zero from t = [12]" words
  > done
  1
  1
  1
  1

One that is zero again and again has a row each time it comes there; one that begins at zero has none, and is named too:

  $ steady "max(sin(x), 0)=0" | holds --where 'event=max(sin(x), 0)=0' 't = [pi, 3*pi] +- 1e-12'
  integrators: max(sin(x), 0)=0 stays at zero 2 times, first from t = 3.14159265 to 6.28318531
  $ for rest in "max(x - 2, 0)" "max(t - 2, 0)" "step(t - 2)"; do steady "rest: $rest" | cut -d, -f3 | paste -s -d'|'; done
  integrators: rest stays at zero from t = 0 to 2
  event||
  integrators: rest stays at zero from t = 0 to 2
  event||
  integrators: rest stays at zero from t = 0 to 2
  event||

One that is zero by rounding alone, as 1 - erf(t) from 5.92 on, is undecided from there:

  $ for tail in 'erf(t) = 1' 'erf(x) = 1' '1 - erf(t)'; do steady "tail: $tail" | cut -d, -f3 | paste -s -d'|'; done
  integrators: tail cannot be distinguished from zero between t = 5.9* and 10: rows may be missing, and those there may be none (glob)
  event||tail|
  integrators: tail cannot be distinguished from zero between t = 5.9* and 10: rows may be missing, and those there may be none (glob)
  event||tail|
  integrators: tail cannot be distinguished from zero between t = 5.9* and 10: rows may be missing, and those there may be none (glob)
  event||tail|

A fall with drag passes 19 m/s at 2 log(19.62/0.62):

  $ integrate "v' = 9.81 - 0.5 v" --initial v=0 --until 400 --event "rest: floor(v) = 19 end" 2> words | holds 't = 2*log(19.62/0.62) +- 1e-6'

Functions that rounding makes zero end nothing:

  $ for rest in "tanh(t) = 1" "exp(-30 t^2)" "1 - tanh(2 x)" "tanh(3 x) = 1"; do
  >   integrate "x' = 1" --initial x=0 --until 100 --event "rest: $rest end" 2> words | holds 't = 100'
  > done

The wrap of a phase, where mod jumps onto zero, and jumps past a value, which are none:

  $ steady 'mod(x, 2)=0' | holds --where 'event=mod(x, 2)=0' 't = 2*(i + 1) +- 1e-12' 'n = 4'
  integrators: mod(x, 2)=0 cannot be distinguished from zero between t = 9.99* and 10: rows may be missing, and those there may be none (glob)
  $ steady 'mod(x, 2)=1 rising' | holds --where 'event=mod(x, 2)=1 rising' 't = 2*i + 1 +- 1e-12' 'n = 5'

Names, and the n-th event:

  $ swing "low: x'=0 rising" | holds --where 'event=low' 'n = 2' 't = pi*(2*i + 1) +- 1e-8'
  $ swing "x=0 end after 2" | holds 't = 3*pi/2 +- 1e-8'

Changes of the state
--------------------

A ball from 1 m keeps 0.8 of its speed: the k-th flight takes 2 0.8^k of the first fall. Rows come in pairs, before and after:

  $ integrate "y'' = -9.81" --initial "y=1, y'=0" --until 3.5 --event "bounce: y=0 falling" --set-at "bounce: y' = -0.8 y'" > ball.csv
  $ holds --where event=bounce 'T := sqrt(2/9.81)' 'n = 9' 't = T*(1 + 2*(0.8 - 0.8**(i + 1))/0.2) +- 1e-8' "y' = -9.81*T*0.8**i +- 1e-7" < ball.csv
  $ holds --where 'event=bounce after' "y' = 9.81*sqrt(2/9.81)*0.8**(i + 1) +- 1e-7" < ball.csv

The same in a file, by another method:

  $ cat > ball.ode << END
  > y'' = -g
  > g = 9.81
  > y(0) = 1
  > y'(0) = 0
  > when y = 0 falling: y' -> -0.8 y'  # keeps 0.8
  > t <= 3.5
  > END
  $ integrators integrate --file ball.ode --method dop853 > file.csv
  $ tail -1 file.csv | tr , '\n' | head -2 > end; tail -1 ball.csv | tr , '\n' | head -2 | paste - end |
  >   awk '{ d = $1 - $2; if (d*d > 1e-14) print }'

Its bounces end after 1 + 2 0.8/0.2 = 9 times the first fall, at 4.06 s:

  $ integrators integrate --file ball.ode --until 5
  integrators: outside_validity: events that change the state accumulate at t = 4.06*; end the run before, or at one of them (glob)
  [1]

A dose of 5 at 0, 24, ..., 240 h, of which exp(-2.4) is left after a day:

  $ integrate "c' = -0.1 c; c(0) = 0; at t = 0:24:240: c -> c + 5" --until 250 --method ode45 |
  >   holds 'c = 5*exp(-1)*(1 - exp(-2.4*11))/(1 - exp(-2.4)) +- 2e-8'
  $ { echo c; echo 0; echo 1; } > starts.csv
  $ integrate "c' = -0.1 c" --until 250 --event "dose: t = 0:24:240" --set-at "dose: c = c + 5" --states starts.csv > rows.csv
  $ holds --where t=250 'n = 2' 'c = exp(-25)*i + 5*exp(-1)*(1 - exp(-2.4*11))/(1 - exp(-2.4)) +- 2e-8' < rows.csv

Changes at one time are all made, in their order, and an end there counts too:

  $ integrate "a' = -0.1 a; b' = -0.2 b" --initial "a=0, b=0" --until 30 --event "A: t=0:12:24" "B: t=0:24:24" --set-at "A: a=a+10" "B: b=b+5" |
  >   holds --where t=30 'a = 10*(exp(-3) + exp(-1.8) + exp(-0.6)) +- 1e-7' 'b = 5*(exp(-6) + exp(-1.2)) +- 1e-7'
  $ integrate "x'' = -9.81; y'' = -9.81; when x=0 falling: x' -> -0.8 x'; when y=0 falling: y' -> -0.8 y'" --initial "x=1, x'=0, y=1, y'=0" --until 1 > corner.csv
  $ holds --where t=1 'T := sqrt(2/9.81)' 'h := 0.8*9.81*T*(1 - T) - 4.905*(1 - T)**2' 'x = h +- 1e-8' 'y = h +- 1e-8' < corner.csv
  $ integrate "c' = -0.1 c; c(0) = 10" --until 100 --event "d: t=10" "e: t=10 end" --set-at "d: c=c+10" | cut -d, -f 1,3 | paste -s -d '|'
  t,event|0,|10,d|10,d after|10,e

A row that is asked for at the time of a dose is its row before and its row after, at the end too:

  $ integrate "c' = 0; c(0) = 1" --until 3 --every 1 --event "dose: t = 2:1:3" --set-at "dose: c = c + 5"
  t,c,event
  0,1,
  1,1,
  2,1,dose
  2,6,dose after
  3,6,dose
  3,11,dose after
  $ integrate "x' = 1" --initial x=0 --until 2 --at 1,1.5 --event "half: x=1" | cut -d, -f 1,3
  t,event
  0,
  1,half
  1.5,
  2,

A threshold sets the state, and several values change at once, each by the values before:

  $ integrate "x' = -x; x(0) = 1" --until 10 --event "low: x=0.5 falling" --set-at "low: x = 1" |
  >   holds 'x = exp(-10 + 14*log(2)) +- 2e-8'
  $ integrate "x' = 0; y' = 0; x(0) = 1; y(0) = 2; at t = 1:1:1: x -> y, y -> x + atan2(0, 1)" --until 2 | holds 'x = 2' 'y = 1'

Mistakes
--------

  $ decay() { integrate "x' = -x; x(0) = 1" --until 2 "$@"; }
  $ decay --event "a: x=0.5" --set-at "b: x=2"
  integrators: --set-at b: x=2: no --event has the name b; name one of them
  [2]
  $ decay --event "a: x=0.5" --set-at "a: z=2"
  integrators: --set-at a: z=2: z=2: must be one of x = its new value
  [2]
  $ decay --event "a: x=0.5" --set-at "a: x=2; x=3"
  integrators: --set-at a: x=2; x=3: x has two values; give one
  [2]
  $ decay --event "a: x=0.5" --set-at "a: x=2" --set-at "a: x=3"
  integrators: --set-at a: x=3: another change of a gives x a value; leave one of them out
  [2]
  $ decay --event "a: x=0.5" --set-at "x=2"
  integrators: --set-at x=2: give the name of an event and what it changes: "bounce: y' = -0.8 y'"
  [2]
  $ decay --event "a: x=0.5" --set-at "a: x=z"
  integrators: --set-at:1:1: z is not defined: it has neither a derivative (z') nor a definition (z = ...)
    z
    ^
  [2]
  $ decay --event "a: x=0.5" --set-at "a: x=log(-x)"
  integrators: non_finite: event: the state after its change at t = 0.69314718* is not finite; give a change that is defined there (glob)
  [1]
  $ integrate "x' = -x; x(0) = 1" --until -2 --event "a: x=0.5" --set-at "a: x=2"
  integrators: --until -2: is before the start, 0; events that change the state need a later end
  [2]
  $ decay --event "a: x=0.5 end after z"
  integrators: --event x=0.5 end after z: end after z: must be a whole number of events, from 1 to 1e9
  [2]
  $ decay --event "a: t = 0:0:3"
  integrators: --event t = 0:0:3: give the first time, a positive interval and a last time that is not earlier, as t = 0:24:240
  [2]
  $ integrators compare --file ball.ode
  integrators: when y = 0 falling: compare does not support events; take integrate, or remove them
  [2]
