# gnuplot script; run it in its own folder: gnuplot 'Phi_eta.gp'
set encoding utf8
set title 'Solid fraction at I = 0.2 (quick size)'
set xlabel 'cohesion number eta'
set ylabel 'Phi'
set autoscale noextend
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,562 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './Phi_eta.svg'
plot './Phi_eta.dat' index 0 using 1:($2-$3):($2+$3) with filledcurves fillcolor rgb '#0072b2' fillstyle transparent solid 0.2 noborder title 'mu = 0, md', \
     './Phi_eta.dat' index 0 using 1:2 with lines linecolor rgb '#0072b2' linewidth 1.5 notitle, \
     './Phi_eta.dat' index 1 using 1:($2-$3):($2+$3) with filledcurves fillcolor rgb '#d55e00' fillstyle transparent solid 0.2 noborder title 'mu = 0, cd', \
     './Phi_eta.dat' index 1 using 1:2 with lines linecolor rgb '#d55e00' linewidth 1.5 notitle, \
     './Phi_eta.dat' index 2 using 1:($2-$3):($2+$3) with filledcurves fillcolor rgb '#009e73' fillstyle transparent solid 0.2 noborder title 'mu = 0.4, md', \
     './Phi_eta.dat' index 2 using 1:2 with lines linecolor rgb '#009e73' linewidth 1.5 notitle, \
     './Phi_eta.dat' index 3 using 1:($2-$3):($2+$3) with filledcurves fillcolor rgb '#cc79a7' fillstyle transparent solid 0.2 noborder title 'mu = 0.4, cd', \
     './Phi_eta.dat' index 3 using 1:2 with lines linecolor rgb '#cc79a7' linewidth 1.5 notitle
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1124 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './Phi_eta.png'
replot
set output
