What integrate and compare refuse
=================================

Each ends with 2, prints nothing to standard output, and says option, value and what there is.

The text of an equation, with its place
---------------------------------------

  $ equation() { refused integrators integrate --until 1 --equation "$@"; }
  $ equation "x'' + y = 0" --initial "x=1, x'=0"
  integrators: --equation:1:7: y is not defined: it has neither a derivative (y') nor a definition (y = ...)
    x'' + y = 0
          ^
  $ equation "x'' = -x" --initial x=1
  integrators: --equation:1:1: an initial value is missing: --initial x'=...
    x'' = -x
    ^^^
  $ equation "x' = -x" --initial "x=1, x=2"
  integrators: --initial:1:6: given twice
    x=1, x=2
         ^
  $ equation "x' = -x" --problem lorenz
  integrators: give one of --problem NAME, --equation TEXT and --file NAME.ode
  $ equation "x' = -a x; a = 1" --set b=1 --initial x=1
  integrators: --set b: the equation has no such definition; choose one of a
  $ equation "x' = -x" --initial x=1 --event z=0
  integrators: --event:1:1: z is not defined: it has neither a derivative (z') nor a definition (z = ...)
    z=0
    ^
  $ equation "x' = -x" --initial x=1 --event "x'=0"
  integrators: --event:1:1: x' is not allowed here: it is not a component of the state
    x'=0
    ^^
  $ equation "x' = -x" --initial x=1 --section x=1 --every 1
  integrators: --section prints only its own rows; leave out --event, --every and --at
  $ refused integrators integrate --until 1
  integrators: give one of --problem NAME, --equation TEXT and --file NAME.ode
  $ refused integrators integrate --until 1 --method rk4
  integrators: give one of --problem NAME, --equation TEXT and --file NAME.ode
  $ refused integrators integrate "x' = -x; x(0) = 1" --until 1
  The following argument was not expected: x' = -x; x(0) = 1
  An equation follows --equation.
  Run with --help for more information.
  $ refused integrators integrate --equation "x'=-x" --initial 1 --method rk4
  integrators: --until: missing; give the time at which the run ends, or t <= ... in the text
  $ refused integrators compare --equation "x'^2 = x" --initial x=1 --until 1 --methods all
  integrators: --equation:1:1: x' is in a power; a highest derivative must occur linearly
    x'^2 = x
    ^^

The options of a run
--------------------

  $ run() { refused integrators integrate --equation "x'' = -x + a; a = 0; x(0) = 1; x'(0) = 0" "$@"; }
  $ run
  integrators: --until: missing; give the time at which the run ends, or t <= ... in the text
  $ run --until nan
  integrators: --until nan: not a finite number
  $ run --until inf
  integrators: --until inf: not a finite number
  $ run --until 1e400
  integrators: --until 1e400: not a finite number
  $ run --until ''
  integrators: --until: an empty text
  $ run --until 1 --until 2
  --until: At Most 1 required but received 2
  Run with --help for more information.
  $ run --until 1 --from nan
  integrators: --from nan: not a finite number
  $ run --until 1 --every 0
  integrators: --every 0: must be positive
  $ run --until 1 --every -1
  integrators: --every -1: must be positive
  $ run --until 100 --every 1e-9
  integrators: --every 1e-09: more than 10 million rows
  $ run --until 1 --tolerance 0
  integrators: --tolerance 0: must be positive
  $ run --until 1 --tolerance 1e-6 --step 0.1
  integrators: --step 0.1 --tolerance 1e-06: give a step or a tolerance, not both
  $ run --until 1 --method nosuch
  integrators: --method: there is no method 'nosuch'; choose one of euler, *, rbf-coll, *, odeint-dopri5, * (glob)
  $ run --until 1 --method ode45 --step 0.1
  integrators: --method: ode45: its steps are adaptive; give a tolerance, not a step
  $ run --until 1 --method rk4 --nodes 7
  integrators: --method: rk4: it has no setting nodes
  $ run --until 1 --largest-step 0
  integrators: --largest-step 0: must be positive
  $ run --until 1 --largest-step -1
  integrators: --largest-step -1: must be positive
  $ run --until 1 --largest-step inf
  integrators: --largest-step inf: not a finite number
  $ run --until 1 --largest-step 0.1 --method rk4
  integrators: --largest-step 0.1: rk4 takes equal steps; give --step, or a method with adaptive steps
  $ run --until 1 --largest-step 0.1 --step 0.1
  integrators: --step 0.1 --largest-step 0.1: give equal steps or a bound on adaptive steps, not both
  $ run --until 1 --event ''
  integrators: --event: an empty text
  $ run --until 1 --event 'x<0'
  integrators: --event:1:2: expected an operator or the end
    x<0
     ^
  $ run --until 1 --event '=0'
  integrators: --event:1:1: expected a number, a name or (
    =0
    ^
  $ run --until 1 --event 'x=0=1'
  integrators: --event:1:4: an equation must have exactly one sign =
    x=0=1
       ^
  $ run --until 1 --event 'x=0 sideways'
  integrators: --event:1:5: sideways is not defined: it has neither a derivative (sideways') nor a definition (sideways = ...)
    x=0 sideways
        ^^^^^^^^
  $ run --until 1 --event 'x=0 end end'
  integrators: --event:1:5: end is not defined: it has neither a derivative (end') nor a definition (end = ...)
    x=0 end
        ^^^
  $ run --until 1 --section x=0 --event x=1
  integrators: --section prints only its own rows; leave out --event, --every and --at
  $ run --until 1 --initial y=1
  integrators: --initial:1:1: no component of the state; these are x, x'
    y=1
    ^
  $ run --until 1 --initial "x''=1"
  integrators: --initial:1:1: no component of the state; these are x, x'
    x''=1
    ^^^
  $ run --until 1 --initial 'x=1, x=2'
  integrators: --initial:1:6: given twice
    x=1, x=2
         ^
  $ run --until 1 --initial x=1/0
  integrators: --initial:1:5: a division by zero
    x=1/0
        ^
  $ run --until 1 --initial "x=x'"
  integrators: --initial:1:3: an initial value must be a number, or an expression of constants
    x=x'
      ^^
  $ run --until 1 --initial x=nan
  integrators: --initial:1:3: nan is not defined: it has neither a derivative (nan') nor a definition (nan = ...)
    x=nan
      ^^^
  $ run --until 1 --initial 1,2,3
  integrators: --initial 1,2,3: 3 numbers for the 2 components x,x' of the equation: x'' = -x + a
  $ run --until 1 --initial 1,two
  integrators: --initial 1,two: 'two' is not a finite number
  $ run --until 1 --set a
  integrators: --set a: must be name=value
  $ run --until 1 --set a=nan
  integrators: --set a=nan: the value is not a number
  $ run --until 1 --set a=1 a=2
  integrators: --set a=2: a is set twice, also by a=1
  $ run --until 1 --set x=2
  integrators: --set x: the equation has no such definition; choose one of a
  $ run --until 1 --problem lorenz
  integrators: give one of --problem NAME, --equation TEXT and --file NAME.ode
  $ run --until 1 --file a.ode
  integrators: give one of --problem NAME, --equation TEXT and --file NAME.ode
  $ run --until 1 --frobnicate
  The following argument was not expected: --frobnicate
  Run with --help for more information.

Problems of the library
-----------------------

  $ duffing() { refused integrators integrate --problem duffing --until 1 "$@"; }
  $ duffing --initial 'x=1, y=2'
  integrators: --initial:1:6: no component of the state; these are x, x'
    x=1, y=2
         ^
  $ duffing --initial 'x=1, x=2'
  integrators: --initial:1:6: given twice
    x=1, x=2
         ^
  $ duffing --initial "x'=oops"
  integrators: --initial:1:4: oops is not defined: it has neither a derivative (oops') nor a definition (oops = ...)
    x'=oops
       ^^^^
  $ duffing --event y=0
  integrators: --event:1:1: y is not defined: it has neither a derivative (y') nor a definition (y = ...)
    y=0
    ^
  $ duffing --set mass=1
  integrators: --set mass: the equation has no such definition; choose one of hardening, natural_frequency
  $ refused integrators integrate --problem pendulum --until 1 --method rk4
  integrators: --problem pendulum: there is no such problem; choose one of arenstorf, blow-up, *, duffing, *, three-dof, * (glob)
  $ duffing --method magic
  integrators: --method: there is no method 'magic'; choose one of euler, *, rbf-coll, *, odeint-dopri5, * (glob)
  $ duffing --method rk4 --set stiffness=2
  integrators: --set stiffness: the equation has no such definition; choose one of hardening, natural_frequency
  $ duffing --method rk4 --set hardening
  integrators: --set hardening: must be name=value
  $ duffing --method rk4 --set hardening=two
  integrators: --set hardening=two: the value is not a number
  $ duffing --method rk4 --set hardening=2 --set hardening=3
  integrators: --set hardening=3: hardening is set twice, also by hardening=2
  $ duffing --method rk4 --set hardening=2 natural_frequency=1 hardening=2
  integrators: --set hardening=2: hardening is set twice, also by hardening=2
  $ duffing --method rk4 --initial 1
  integrators: --initial 1: 1 numbers for the 2 components x,x' of duffing: x'' = -natural_frequency^2 x - hardening x^3
  $ duffing --method rk4 --initial 1,2,3
  integrators: --initial 1,2,3: 3 numbers for the 2 components x,x' of duffing: x'' = -natural_frequency^2 x - hardening x^3
  $ duffing --method rk4 --initial 1,two
  integrators: --initial 1,two: 'two' is not a finite number
  $ duffing --method rk4 --initial 1,nan
  integrators: --initial 1,nan: 'nan' is not a finite number
  $ refused integrators integrate --problem duffing --method rk4 --until inf
  integrators: --until inf: not a finite number
  $ refused integrators integrate --problem duffing --method rk4 --until 1e999
  integrators: --until 1e999: not a finite number
  $ refused integrators integrate --problem duffing --method rk4 --until soon
  integrators: --until:1:1: soon is not defined: it has neither a derivative (soon') nor a definition (soon = ...)
    soon
    ^^^^
  $ duffing --method rk4 --from -x
  integrators: --from:1:1: a time must be a number, or an expression of constants
    -x
    ^^
  $ duffing --method rk4 --step 0
  integrators: --step 0: must be positive
  $ duffing --method rk4 --step -0.1
  integrators: --step -0.1: must be positive
  $ duffing --method rk4 --tolerance -1e-9
  integrators: --tolerance -1e-9: must be positive
  $ duffing --method rk4 --tolerance tight
  integrators: --tolerance tight: not a finite number
  $ duffing --method ode45 --absolute-tolerance 0
  integrators: --absolute-tolerance 0: must be positive
  $ duffing --method rk4 --every 0
  integrators: --every 0: must be positive
  $ duffing --method rk4 --every 1e-12
  integrators: --every 1e-12: more than 10 million rows
  $ duffing --method rk4 --limit 0
  integrators: --limit 0: must be positive
  $ duffing --method rk4 --frobnicate 1
  The following arguments were not expected: --frobnicate 1
  Run with --help for more information.

What a method does not have
---------------------------

  $ duffing --method rk4
  integrators: --method: rk4: it takes equal steps: give a step, or a method with adaptive steps, as series or dop853
  $ duffing --method rk4 --tolerance 1e-9
  integrators: --method: rk4: it takes equal steps: give a step, or a method with adaptive steps, as series or dop853
  $ duffing --method rk4 --step 0.1 --tolerance 1e-9
  integrators: --step 0.1 --tolerance 1e-09: give a step or a tolerance, not both
  $ duffing --method rk4 --absolute-tolerance 1e-9
  integrators: --method: rk4: an absolute tolerance needs a method with adaptive steps
  $ duffing --method rk4 --nodes 7
  integrators: --method: rk4: it has no setting nodes
  $ duffing --method rbf-coll --nodes 1
  integrators: --nodes 1: must be a whole number from 2 to 200
  $ duffing --method rbf-coll --nodes 201
  integrators: --nodes 201: must be a whole number from 2 to 200
  $ duffing --method rbf-coll --nodes 7.5
  integrators: --nodes 7.5: must be a whole number from 2 to 200
  $ duffing --method rbf-coll --shape 0
  integrators: --shape 0: must be positive
  $ duffing --method lgl-coll --shape 1
  integrators: --method: lgl-coll: it has no setting shape
  $ duffing --method ode45 --step 0.1
  integrators: --method: ode45: its steps are adaptive; give a tolerance, not a step
  $ duffing --method ode45 --tolerance 1e-17
  integrators: --method: ode45: relative_tolerance must be between 2.22045e-14 and 0.1, not 1e-17
  $ refused integrators integrate --problem robertson --until 1 --method newmark --step 0.1
  integrators: --method: newmark: the problem gives no acceleration(t, q, v), which this method needs; take another method
  $ refused integrators integrate --problem blow-up --until 0.1 --method newmark --step 0.1
  integrators: --method: newmark: the problem gives no acceleration(t, q, v), which this method needs; take another method

Of a comparison
---------------

  $ compare() { refused integrators compare --problem duffing --until 1 --methods "$@"; }
  $ compare rk4,magic
  integrators: --methods: there is no method 'magic'; choose one of euler, *, rbf-coll, *, odeint-dopri5, * (glob)
  $ compare rk4,
  integrators: --methods: there is no method ''; choose one of euler, *, rbf-coll, *, odeint-dopri5, * (glob)
  $ compare rk4,radau-coll --absolute-tolerance 1e-9
  integrators: --absolute-tolerance 1e-09: none of the methods rk4,radau-coll has adaptive steps
  $ compare ode45,series --step 0.1 --tolerance 1e-6
  integrators: --step 0.1: the methods ode45,series have adaptive steps; give a tolerance only
  $ compare rk4,rk6 --step 0.1 --tolerance 1e-6
  integrators: --tolerance 1e-06: none of the methods rk4,rk6 has adaptive steps; give --step only
  $ compare ode45,dop853 --step 0.1
  integrators: reference: Taylor series of order 22 and Taylor series of order 28 agree to * digits (glob)
  integrators: ode45: its steps are adaptive; give a tolerance, not a step
  integrators: dop853: its steps are adaptive; give a tolerance, not a step
  integrators: --methods: none of them suits the problem: ode45: its steps are adaptive; give a tolerance, not a step; dop853: its steps are adaptive; give a tolerance, not a step
  $ compare rk4,ode45 --nodes 7
  integrators: --nodes 7: none of the methods rk4,ode45 has the setting nodes
  $ compare lgl-coll --shape 7
  integrators: --shape 7: none of the methods lgl-coll has the setting shape
  $ sweep() { refused integrators compare --equation "x' = -x" --initial x=1 --until 1 --tolerances "$@"; }
  $ sweep 1e-12:1e-3
  integrators: --tolerances 1e-12:1e-3: must be the larger tolerance first, as 1e-3:1e-12
  $ sweep 1e-3:
  integrators: --tolerances 1e-3:: must be a larger and a smaller tolerance, as 1e-3:1e-12
  $ sweep :
  integrators: --tolerances :: must be a larger and a smaller tolerance, as 1e-3:1e-12
  $ sweep 1e-3:1e-6:1e-9
  integrators: --tolerances 1e-3:1e-6:1e-9: must be a larger and a smaller tolerance, as 1e-3:1e-12
  $ sweep 1e-3,,1e-6
  integrators: --tolerances 1e-3,,1e-6: '' is not a finite number
  $ sweep 0
  integrators: --tolerances 0: must be positive
  $ sweep -1e-3
  integrators: --tolerances -1e-3: must be positive
  $ sweep nan
  integrators: --tolerances nan: 'nan' is not a finite number
  $ sweep 1e-3:0
  integrators: --tolerances 0: must be positive
  $ sweep 1:1e-300
  integrators: --tolerances 1:1e-300: more than thirty decades; give a shorter sweep
  $ sweep few
  integrators: --tolerances few: 'few' is not a finite number
  $ sweep 1e-3 --tolerance 1e-6
  integrators: --tolerances: excludes --tolerance; give one of them
  $ sweep 1e-3 --methods rk4,rk6 --step 0.1
  integrators: --tolerances: none of the methods rk4,rk6 has adaptive steps; give --step only
  $ sweep 1e-3 --methods ode45,ode45
  integrators: --methods: ode45 is given twice
  $ sweep 1e-3 --methods ode45,,rk4
  integrators: --methods: there is no method ''; choose one of euler, *, rbf-coll, *, odeint-dopri5, * (glob)
  $ sweep 1e-3 --methods all,rk4
  integrators: --methods: there is no method 'all'; choose one of euler, *, rbf-coll, *, odeint-dopri5, * (glob)

Files
-----

  $ file() { refused integrators integrate --until 1 --initial x=1 --file "$1"; }
  $ file nowhere.ode
  integrators: nowhere.ode: No such file or directory
  $ file .
  integrators: .: is a folder, not a file
  $ file /dev/zero
  integrators: --file /dev/zero: is a device; give a file, or - for standard input
  $ printf '' > empty.ode
  $ file empty.ode
  integrators: empty.ode:1:1: there is no unknown: a derivative is written x' or x''
   * (re)
    ^
  $ printf '\n\n   # nothing\n' > blank.ode
  $ file blank.ode
  integrators: blank.ode:1:1: there is no unknown: a derivative is written x' or x''
   * (re)
    ^
  $ printf '\177ELF\002\001\000\000\377\376' > binary.ode
  $ file binary.ode
  integrators: binary.ode:1:1: \x7f has no meaning here
    \x7fELF\x02\x01\x00\x00\xff\xfe
    ^^^^
  $ head -c 1000 /dev/zero > zeros.ode
  $ file zeros.ode
  integrators: zeros.ode:1:1: \x00 has no meaning here
    \x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00
    ^^^^
  $ { printf "x' = -x "; head -c 1000001 /dev/zero | tr '\0' ' '; } > huge.ode
  $ file huge.ode
  integrators: --file huge.ode: more than 1000000 bytes
  $ printf "x' = -x\ny'' = sin(z)\n" > typo.ode
  $ file typo.ode
  integrators: typo.ode:2:11: z is not defined: it has neither a derivative (z') nor a definition (z = ...)
    y'' = sin(z)
              ^

Whatever is wrong, the terminal gets no control character and no endless line:

  $ equation "$(printf "x' = \033[31m")" --initial x=1
  integrators: --equation:1:6: \x1b has no meaning here
    x' = \x1b[31m
         ^^^^
  $ equation "$(head -c 20000 /dev/zero | tr '\0' '(')" --initial x=1
  integrators: --equation:1:201: nested more than 200 deep
    (((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((
                                                      ^
  $ equation "x' = $(head -c 20000 /dev/zero | tr '\0' q)" --initial x=1
  integrators: --equation:1:6: a name must have at most 60 characters
    x' = qqqqqqqqqqqqqqqqqqqqqqqqq
         ^^^^^^^^^^^^^^^^^^^^^^^^^
  $ equation "$(printf "x' = \303(")" --initial x=1
  integrators: --equation:1:6: \xc3 has no meaning here
    x' = \xc3(
         ^^^^
  $ equation "$(printf "x'\n= \t\r ]")" --initial x=1
  integrators: --equation:2:6: ] has no meaning here
    = \t\x0d ]
             ^
