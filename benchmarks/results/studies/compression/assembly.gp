# gnuplot script; run it in its own folder: gnuplot 'assembly.gp'
set encoding utf8
set title 'Spheres compressed from a gas (quick size)'
set xlabel 'inertial number of the approach {/:Italic I}'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [0.0008:0.125]
set ylabel 'Phi at rest'
set autoscale noextend
set offsets 0, 0, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,562 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './assembly.svg'
plot './assembly.dat' index 0 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md, kappa = 39000', \
     './assembly.dat' index 1 using 1:2:3 with yerrorbars linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'cd, rigid'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1124 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './assembly.png'
replot
set output
