<?xml version="1.0" encoding="UTF-8"?>
<core:Ci9999999999tyModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:dexxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx 1 1</gml:upperCorner></gml:Envelope></gml:boundedBy>
<core:cityObjectMemberG::28992" srsDimension="3"><gml:lowerCorner>0 0 0</gml:lowergml:surfaceMC