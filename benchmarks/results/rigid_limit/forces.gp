# gnuplot script; run it in its own folder: gnuplot 'forces.gp'
set encoding utf8
set title 'Contact forces of a hyperstatic packing'
set xlabel 'stiffness level'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [80:12500000]
set ylabel 'rms difference of forces / mean force'
set logscale y
set format y '10^{%L}'
set mytics 10
set yrange [1.098133384832823e-08:1.0645542960449066]
set offsets 0, 0, 0, 0
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,584 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './forces.svg'
plot './forces.dat' index 0 using 1:2 with points linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'elastic cd - md, mu = 0.5', \
     './forces.dat' index 1 using 1:2 with points linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'md - md at 1e7, mu = 0.5', \
     './forces.dat' index 2 using 1:2 with points linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'elastic cd - md, mu = 10', \
     './forces.dat' index 3 using 1:2 with points linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'md - md at 1e7, mu = 10'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1168 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './forces.png'
replot
set output
