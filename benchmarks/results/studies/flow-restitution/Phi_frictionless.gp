# gnuplot script; run it in its own folder: gnuplot 'Phi_frictionless.gp'
set encoding utf8
set title 'Effect of restitution, mu = 0 (quick size)'
set xlabel 'inertial number {/:Italic I}'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [0.01:1]
set ylabel 'Phi'
set autoscale noextend
set offsets 0, 0, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,562 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './Phi_frictionless.svg'
plot './Phi_frictionless.dat' index 0 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'e = 0.1, md', \
     './Phi_frictionless.dat' index 1 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 6 pointsize 0.7 linewidth 1.5 title 'e = 0.1, cd', \
     './Phi_frictionless.dat' index 2 using 1:2:3 with yerrorbars linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'e = 0.9, md', \
     './Phi_frictionless.dat' index 3 using 1:2:3 with yerrorbars linecolor rgb '#009e73' pointtype 8 pointsize 0.7 linewidth 1.5 title 'e = 0.9, cd'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1124 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './Phi_frictionless.png'
replot
set output
