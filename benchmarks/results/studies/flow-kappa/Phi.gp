# gnuplot script; run it in its own folder: gnuplot 'Phi.gp'
set encoding utf8
set title 'Effect of the stiffness of contacts (quick size)'
set xlabel 'stiffness level kappa'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [32:125000]
set ylabel 'Phi'
set autoscale noextend
set offsets 0, 0, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,584 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './Phi.svg'
plot './Phi.dat' index 0 using 1:($2-$3):($2+$3) with filledcurves fillcolor rgb '#0072b2' fillstyle transparent solid 0.2 noborder title 'rigid cd, I = 0.1', \
     './Phi.dat' index 0 using 1:2 with lines linecolor rgb '#0072b2' linewidth 1.5 notitle, \
     './Phi.dat' index 1 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md, I = 0.1', \
     './Phi.dat' index 2 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 6 pointsize 0.7 linewidth 1.5 title 'compliant cd, I = 0.1'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1168 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './Phi.png'
replot
set output
