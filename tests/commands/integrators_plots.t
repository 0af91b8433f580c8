Pictures beside the numbers
===========================

The numbers are what they are without a picture, and nothing else is left in the folder:

  $ swing() { integrators integrate --equation "x'' = -x" --initial "x=0, x'=1" --until 20 "$@"; }
  $ mkdir picture && cd picture
  $ swing --plot a.svg > ../drawn.csv
  $ ls
  a.svg
  $ cd ..
  $ swing | cmp - drawn.csv
  $ tail -1 picture/a.svg
  <!-- drawn by a command of nlmech -->
  $ grep -q -e '-x' picture/a.svg

A comment of XML has no two hyphens, or no browser shows the picture:

  $ python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' picture/a.svg

One panel an unknown, and twelve at most:

  $ for unknowns in 1 2 5 8 13; do
  >   equation=$(seq $unknowns | awk '{printf "y%d'"''"' = -%d y%d; y%d(0) = 1; y%d'"'"'(0) = 0;", $1, $1, $1, $1, $1}')
  >   integrators integrate --equation "$equation" --until 5 --plot y.svg > rows.csv
  >   grep -o ">y[0-9]*'*<" y.svg | sort -u -V | tr -d '<>' | paste -s -d ' '
  > done
  y1
  y1 y2
  y1 y2 y3 y4 y5
  y1 y2 y3 y4 y5 y6 y7 y8
  y1 y2 y3 y4 y5 y6 y7 y8 y9 y10 y11 y12

Names, comments and markup of gnuplot in an equation stay what they are:

  $ integrators integrate --equation "x_1'' + x_1^3 = 0 # {/Bold @~&}'" --initial "x_1=1, x_1'=0" --until 3 --plot a.svg > rows.csv
  $ grep -o -m 1 '>x_1<' a.svg | sort -u
  >x_1<

What never moves, backwards, over decades:

  $ for value in 0 1 -3e-200 7e200; do integrators integrate --equation "x' = 0" --initial x=$value --until 3 --plot a.svg > rows.csv; done
  integrators: x stays below the absolute tolerance 1e-09: none of its digits is certain; take a smaller --absolute-tolerance
  $ for until in 1e6 1e-2; do
  >   integrators integrate --file "$TESTDIR/../../chapters/integrators/examples/robertson.ode" --until $until --plot a.svg > rows.csv
  > done
  $ integrators integrate --equation "x'' = -x" --initial "x=0, x'=1" --until -5 --plot a.svg > rows.csv

A section shows its points, each as a symbol:

  $ integrators integrate --problem lorenz --until 15 --section w=27 --no-verify --plot a.svg > rows.csv
  $ points=$(sed 1d rows.csv | wc -l)
  $ [ $points -gt 10 ] && [ $(grep -o "xlink:href='#gpPt6'" a.svg | wc -l) -eq $points ]
  $ rm a.svg
  $ swing --section x=7 --plot a.svg
  t,x,x',event
  integrators: all numbers are written, but a.svg is not drawn: the run does not meet the section
  [1]
  $ ls a.svg
  ls: cannot access 'a.svg': No such file or directory
  [2]

A comparison names its methods:

  $ integrators compare --problem duffing --until 10 --methods series,ode45,adaptive-collocation --tolerances 1e-4:1e-8 --plot a.svg 2> said.txt | wc -l
  16
  $ grep -o -e '>series' -e '>ode45' -e '>adaptive-collocation' a.svg | sort -u
  >adaptive-collocation
  >ode45
  >series

Nothing is overwritten but a picture of these commands, and no folder is made:

  $ echo '<svg>of somebody else</svg>' > mine.svg
  $ mkdir folder.svg
  $ ln -s mine.svg link.svg
  $ for file in mine.svg folder.svg link.svg nowhere/a.svg mine.svg/a.svg a.png .svg - $(head -c 5000 /dev/zero | tr '\0' a).svg; do
  >   refused integrators integrate --problem duffing --until 1 --plot $file
  >   refused integrators compare --problem duffing --until 1 --plot $file
  > done
  integrators: --plot mine.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  integrators: --plot mine.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  integrators: --plot folder.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  integrators: --plot folder.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  integrators: --plot link.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  integrators: --plot link.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  integrators: --plot nowhere/a.svg: there is no such folder
  integrators: --plot nowhere/a.svg: there is no such folder
  integrators: --plot mine.svg/a.svg: there is no such folder
  integrators: --plot mine.svg/a.svg: there is no such folder
  integrators: --plot a.png: must end in .svg
  integrators: --plot a.png: must end in .svg
  integrators: --plot .svg: must end in .svg
  integrators: --plot .svg: must end in .svg
  integrators: --plot -: must end in .svg
  integrators: --plot -: must end in .svg
  integrators: --plot aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa... (403 bytes) (5004 bytes): File name too long
  integrators: --plot aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa... (403 bytes) (5004 bytes): File name too long
  $ cat mine.svg
  <svg>of somebody else</svg>
  $ for k in 1 2; do swing --plot own.svg > rows.csv; done

Without gnuplot there are numbers:

  $ integrators=$(command -v integrators)
  $ PATH=/nowhere "$integrators" integrate --equation "x'' = -x" --initial "x=0, x'=1" --until 20 --plot a.svg > rows.csv
  integrators: all numbers are written, but a.svg is not drawn: gnuplot: cannot be started: No such file or directory
  [1]
  $ cmp rows.csv drawn.csv
