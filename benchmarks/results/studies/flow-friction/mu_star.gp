# gnuplot script; run it in its own folder: gnuplot 'mu_star.gp'
set encoding utf8
set title 'Friction law against the friction of contacts (quick size)'
set xlabel 'inertial number {/:Italic I}'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [0.01:1]
set ylabel 'mu*'
set autoscale noextend
set offsets 0, 0, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,584 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './mu_star.svg'
plot './mu_star.dat' index 0 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'mu = 0, md', \
     './mu_star.dat' index 1 using 1:2:3 with yerrorbars linecolor rgb '#0072b2' pointtype 6 pointsize 0.7 linewidth 1.5 title 'mu = 0, cd', \
     './mu_star.dat' index 2 using 1:2:3 with yerrorbars linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'mu = 0.1, md', \
     './mu_star.dat' index 3 using 1:2:3 with yerrorbars linecolor rgb '#d55e00' pointtype 4 pointsize 0.7 linewidth 1.5 title 'mu = 0.1, cd', \
     './mu_star.dat' index 4 using 1:2:3 with yerrorbars linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'mu = 0.4, md', \
     './mu_star.dat' index 5 using 1:2:3 with yerrorbars linecolor rgb '#009e73' pointtype 8 pointsize 0.7 linewidth 1.5 title 'mu = 0.4, cd', \
     './mu_star.dat' index 6 using 1:2:3 with yerrorbars linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'mu = 0.8, md', \
     './mu_star.dat' index 7 using 1:2:3 with yerrorbars linecolor rgb '#cc79a7' pointtype 12 pointsize 0.7 linewidth 1.5 title 'mu = 0.8, cd'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1168 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './mu_star.png'
replot
set output
