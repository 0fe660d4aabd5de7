# Completion of pbmpi, pbstudy and pbreport: the commands and options that --help all lists.
function __pbmpi_complete
    set -l words (commandline -opc)
    set -l command (string match -v -- '-*' $words[2])
    set -l help ($words[1] $command --help all 2>/dev/null)
    string replace -rf '^  (?:-\w, )?(--[\w-]+)(?:.*? {2,})?(.*)' '$1\t$2' -- $help
    test (count $words) -gt 1; or string replace -rf '^  ([a-z]+) {2,}(\S.*)' '$1\t$2' -- $help
end

for program in pbmpi pbstudy pbreport
    complete -c $program -a '(__pbmpi_complete)'
end
