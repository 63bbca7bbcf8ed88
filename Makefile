# make demo   install what is missing, build, light a town (CITY=path TIME=... for your own)
# make test   the same set-up, then every test
