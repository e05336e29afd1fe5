// Hyphenation of the words of the report, as browsers for servers come without patterns. Soft hyphens go into running text alone
// (print_pages.js). Words that are missing here are not hyphenated.
const parted = new Map(`
ac-cepts ac-cu-racy ac-cu-rate adap-tive af-fects al-most al-ready al-ter-nate al-ter-nat-ing al-ways am-pli-fies am-plify anal-y-sis
an-gles an-iso-tropic an-other an-swer an-swered an-swers ap-pen-dix ap-proaches ap-prox-i-ma-tion ap-prox-i-ma-tions ar-bi-trary
arte-facts as-sign-ment asym-me-try avail-able av-er-age av-er-aged back-ward bary-centre bary-cen-tric be-cause be-come be-comes be-fore
be-fore-hand be-gin-ning be-haves be-hind be-long be-longs bel-trami bench-mark be-side bet-ter be-tween be-yond bi-lat-eral bon-net
bound-aries bound-ary bound-ing brack-ets bud-get build-ing bun-dled cam-era can-cel can-not cap-tions cat-e-noid cav-i-ties cen-tral
cen-tre cen-troid cer-tifi-cate cer-tifi-cates chap-ters choos-ing cho-sen cir-cles cir-cum-cen-tres clamp-ing clus-ter coars-est
co-ef-fi-cient co-ef-fi-cients col-lapse col-lapsed col-lapses col-umn col-umns com-pare com-pared com-pares com-par-i-son com-pete
com-plete com-plete-ness com-plex com-po-nent com-po-nents com-pute con-cave con-di-tion con-di-tional con-di-tions con-fi-dence con-firms
con-for-mal con-for-malised con-ju-gate con-nected con-nec-tiv-ity con-sid-er-ably con-sis-tent con-stant con-tra-dict con-tributes
con-trol con-verge con-ver-gence con-verges con-verg-ing con-vex co-or-di-nate co-or-di-nates cor-ners cor-rected cor-rects cor-re-la-tion
co-tan-gent cotan-gents course-work cov-er-age cur-rent cur-va-ture cur-va-tures cylin-der damp-ing de-cid-able de-cide de-cided de-cides
de-cid-ing dec-i-mals dec-i-mated de-fault de-fects de-fined def-i-nite de-forms de-gree de-lau-nay de-noise de-noised de-noises
de-nois-ing de-parts de-pend de-pen-dence de-pends deriva-tives de-rived des-brun de-tail de-tailed de-tails de-vi-a-tion de-vi-a-tions
di-ag-o-nal di-ag-o-nals di-a-gram di-a-grams di-am-e-ter dif-fer dif-fer-ence dif-fer-ences dif-fer-ent dif-fu-sion di-men-sion-less
di-rec-tion di-rec-tions dirich-let dis-crep-ancy dis-crete dis-creti-sa-tion dis-cus-sion dis-place-ment dis-tance dis-tor-tion dis-torts
di-verge di-ver-gence di-vided di-vides di-vid-ing dou-bled ear-lier eas-i-est ef-fec-tive eigen-func-tions eigen-mode eigen-modes
eigen-pair eigen-pairs eigen-prob-lem eigen-prob-lems eigen-solve eigen-solver eigen-value eigen-values eigen-vector eigen-vec-tors
ei-ther el-lipse el-lipses el-lip-soid el-lip-soids else-where en-close en-closed en-closes en-er-gies en-ergy en-tries equa-tion er-rors
es-ti-mate es-ti-mated es-ti-mates es-ti-ma-tor es-ti-ma-tors every-where ex-actly ex-am-ined ex-ceeds ex-cep-tions ex-cess ex-changed
ex-clude ex-cluded ex-cludes ex-pected ex-pects ex-per-i-ment ex-per-i-ments ex-plains ex-plicit ex-pres-sion ex-trema ex-tremely fac-tor
fac-tored fac-tori-sa-tion fac-tori-sa-tions fac-tors faith-ful fall-ing far-ther far-thest fea-tures fig-ures fil-ter
fil-ter-ing fil-ters fit-ted fold-ers fol-lows for-bids fore-sees for-mula for-ward frac-tion fre-quen-cies fre-quent func-tion func-tions
fun-da-men-tal fur-ther gauss-ian gen-eral gen-er-alised gen-er-a-tor gen-tlest geo-met-ric gersh-gorin get-ting gra-di-ent gra-di-ents
grow-ing halv-ing han-dled hap-pens hard-est haus-dorff high-est how-ever hun-dred hun-dredth hutchin-son icosa-he-dron ico-sphere
iden-ti-cal iden-ti-ties iden-tity im-plicit im-plic-itly im-prove im-proves in-ac-cu-rate in-cluded in-def-i-nite in-de-pen-dent
in-di-cated in-di-cates in-di-ca-tor in-equal-ity in-er-tia in-ferred in-fi-nite in-flu-ence in-side in-spected in-sta-bil-i-ties
in-sta-bil-ity in-stead in-te-gral in-te-grates in-ter-po-lated in-ter-val in-trin-sic in-verse in-wards ir-reg-u-lar it-er-a-tion
it-er-a-tions it-self jit-tered keep-ing know-ing knowl-edge lab-o-ra-tory lanc-zos lapla-cian leg-ends let-tered let-ters lev-els
like-wise lim-its lin-ear lit-er-ally lit-tle log-a-rith-mic long-est mag-nify mag-ni-tude ma-jor-ity man-i-fold ma-tri-ces ma-trix
mat-ters max-i-mum mea-sure mea-sured mea-sure-ment mea-sures mea-sur-ing me-dian me-di-ans meth-ods mid-dle min-ima min-i-mum miss-ing
mis-takes mol-li-fied mo-tion mul-ti-ple mul-ti-ples mul-ti-pli-ca-tions mul-ti-plied mul-ti-plies mul-ti-ply nar-rower near-est nee-dle
neg-a-tive neigh-bour neigh-bour-ing neigh-bours nei-ther nest-ing neu-mann nineti-eth non-man-i-fold nor-mal nor-mals noth-ing num-ber
num-bers nu-mer-i-cal ob-tuse open-ing op-er-a-tions op-er-a-tor op-er-a-tors opin-ion op-po-site ori-entable ori-en-ta-tion orig-i-nal
or-thog-o-nal or-thonor-mal or-thonor-mal-ity os-cu-lat-ing oth-ers oth-er-wise out-grow out-grows out-line out-ward out-wards over-shoot
pa-pers pa-ram-e-ter pa-ram-e-ters parametri-sa-tion para-phrased par-se-val pat-tern per-cent per-cent-age per-centile per-centiles
pic-ture pic-tures piv-ots point-wise poly-gon poly-he-dron poly-no-mial po-si-tions pos-i-tive pre-ci-sion pre-dict pre-dicted
pre-dic-tion pre-dic-tions pre-flight prin-ci-pal prin-ci-ple prod-uct prod-ucts pro-gram pro-jec-tion prop-er-ties pro-por-tion
qua-dratic quad-ra-ture quan-ti-ties quan-tity quar-ter quar-ters ques-tion ques-tions quo-tient ran-dom read-ing read-ings rea-sons
re-builds re-built recog-nised rec-om-mend rec-om-mended re-con-structed re-con-struc-tion re-con-struc-tions re-cover re-cov-ered
re-cov-ers ref-er-ence re-fined re-fine-ment re-fine-ments re-fin-ing re-futed re-gret reg-u-lar rel-a-tive re-mains re-moval re-move
re-moved re-moves re-mov-ing re-pairs re-peated re-place re-placed re-port re-ported re-ports re-pro-duce re-quired re-quire-ments
re-quires re-scale re-scal-ing resid-ual resid-u-als res-o-lu-tion re-solves re-spect re-stored re-stores re-sult re-sults re-versed
rip-ples ris-ing ro-tated rough-ness round-ing sad-dle sad-dles sam-ples sat-isfy scal-ing scat-tered sec-ond sec-onds sec-tion sec-tions
semi-def-i-nite sen-tences se-quence se-quences set-ting set-tings set-tled sev-eral shar-ing short-est shrink-ing sim-i-lar sin-gle
sin-gu-lar small-est smooth-ing smooth-ness some-thing some-times spe-cial spec-tra spec-tral spec-trum spot-ted sta-bil-ity sta-ble
stan-dard stiff-ness stop-ping strong-est struc-ture stud-ies sub-ject suit-ably su-per-po-si-tion sur-face sur-faces sur-vive sur-vives
sym-bolic sym-met-ric sym-me-try sys-tem ta-bles tan-gent tan-gen-tial tan-gents ten-fold the-o-rem the-o-rems the-ory there-fore
thick-est thick-ness thin-ner thou-sand thresh-old through-out to-gether tol-er-ance tol-er-ances to-wards tri-an-gle tri-an-gles
tri-an-gu-la-tion tri-an-gu-la-tions turn-ing twen-ti-eth un-de-cided un-de-fined un-ended un-even uni-form un-rolled un-sta-ble us-able
va-lence val-ues van-ish van-ishes vari-ance vari-ant vari-ants vari-a-tion vec-tors ver-dict ver-dicts ver-tex ver-tices vol-ume
wan-dered warn-ing wave-length wave-lengths weak-est weak-ness what-ever win-ners with-out writ-ten
`.trim().split(/\s+/).map((word) => [word.replaceAll("-", ""), word.split("-").map(({ length }) => length)]));

/// The word with soft hyphens, its letters as they are.
globalThis.hyphenated = (word) => {
    let at = 0;
    return parted.get(word.toLowerCase())?.map((length) => word.slice(at, at += length)).join("\u00ad") ?? word;
};
